-- Reasons are codes with parameters, as JSON (proto/schemas/reason.schema.json). What was written in words before stays as it
-- is, in the code "text". `notes` of jobs is an array of reasons.
UPDATE missions SET reason = json_object('code', 'text', 'parameters', json_object('text', reason))
  WHERE reason IS NOT NULL;
UPDATE jobs SET notes = (
  SELECT json_group_array(json_object('code', 'text', 'parameters', json_object('text', value))) FROM json_each(jobs.notes))
  WHERE notes <> '[]';
