# SPDX-License-Identifier: Apache-2.0
"""What a server has acknowledged of a map's edits and drafts, what that must have left, and whether it is there.

A Ledger holds what was there last and what was acknowledged since, for two callers: one edits the map, one works on
drafts and publishes them. Of each the request that was in flight when the server was killed is its last: it may or may
not have come through, but whole. `differences` tries all that can have happened and says what is other than any of it.
"""
import copy
import threading

FULL = ("kind", "image_a", "image_b", "text", "images", "by", "t_us")


def detail(edit):
    return {field: edit[field] for field in FULL}


def of_draft(known):
    """What stays of an edit when its draft is published: the time is a new one, and which pictures a decision parts shows
    only where it is applied."""
    gone = ("t_us", "images") if known["kind"] == "decide" else ("t_us",)
    return {field: known[field] for field in FULL if field in known and field not in gone}


def asked(request):
    """What the log must say of an edit that is asked for."""
    known = {"kind": request["kind"]}
    for field in ("label", "pictogram"):
        if field in request:
            known["text"] = request[field]
    if "accept" in request:
        known.update(text="accept" if request["accept"] else "reject", image_a=request["prototype_a"],
                     image_b=request["prototype_b"])
    if "blocked" in request:
        known["text"] = "true" if request["blocked"] else "false"
    if "images" in request:
        known["images"] = request["images"]
    if request["kind"] == "add_destination":
        known["image_a"] = request["image"]
    if request["kind"] == "set_destination_picture":
        known["image_b"] = request["image"]
    return known


def entry(change, known):
    return {"change": change, "undone": False, "redoable": False, "known": known}


def next_change(log):
    return max((one["change"] for one in log), default=0) + 1


def add(log, details):
    for one in log:
        one["redoable"] = False
    change = next_change(log)
    log.extend(entry(change, known) for known in details)


def undo(log):
    """Whether there is something to undo."""
    latest = next((one["change"] for one in reversed(log) if not one["undone"]), None)
    for one in log:
        if one["change"] == latest and not one["undone"]:
            one["undone"] = one["redoable"] = True
    return latest is not None


def redo(log):
    earliest = next((one["change"] for one in log if one["redoable"]), None)
    for one in log:
        if one["change"] == earliest and one["redoable"]:
            one["undone"] = one["redoable"] = False
    return earliest is not None


def log_of(edits):
    return [{"change": one["change"], "undone": one["undone"], "redoable": one["redoable"], "known": detail(one)}
            for one in edits]


def log_difference(expected, edits):
    """What is other in a log, or nothing."""
    if len(expected) != len(edits):
        return f"{len(edits)} edits instead of {len(expected)}"
    for number, (one, real) in enumerate(zip(expected, edits)):
        other = [field for field in ("change", "undone", "redoable") if one[field] != real[field]]
        other += [field for field, value in one["known"].items() if real[field] != value]
        if other:
            return f"edit {number} ({real['kind']}, change {real['change']}) has another {', '.join(other)}"
    return None


class State:
    """A map's log, revision and drafts, as far as they are known."""

    def __init__(self, revision, history, drafts):
        self.revision = revision
        self.log = log_of(history)
        self.drafts = {one["id"]: {"name": one["name"], "version": one["version"], "log": log_of(one["edits"])}
                       for one in drafts}
        self.unnamed = []  # drafts whose addition was not acknowledged: names

    def difference(self, found):
        if self.revision != found.revision:
            return f"revision {found.revision} instead of {self.revision}"
        if told := log_difference(self.log, found.history):
            return f"history: {told}"
        missing = set(self.drafts) - set(found.drafts)
        more = [found.drafts[one] for one in found.drafts if one not in self.drafts]
        if missing or [one["name"] for one in more] != self.unnamed:
            return f"drafts: {sorted(missing)} missing, {sorted(one['id'] for one in more)} not expected"
        if any(one["edits"] or one["version"] != 1 for one in more):
            return f"drafts: a new one has edits: {more}"
        for id_, draft in self.drafts.items():
            if draft["version"] != found.drafts[id_]["version"]:
                return f"draft {id_}: version {found.drafts[id_]['version']} instead of {draft['version']}"
            if told := log_difference(draft["log"], found.drafts[id_]["edits"]):
                return f"draft {id_}: {told}"
        return None


class Found:
    """What the server has."""

    def __init__(self, call, map_id):
        self.map = map_id
        self.graph = call("GET", f"/api/v1/maps/{map_id}/graph")
        self.revision = self.graph["revision"]
        self.history = call("GET", f"/api/v1/maps/{map_id}/history")["edits"]
        self.drafts = {one["id"]: one for one in call("GET", f"/api/v1/maps/{map_id}/drafts")["drafts"]}


class Request:
    """A change that was asked for. `answer` is what came back, None while it is in flight."""

    def __init__(self, kind, **asked_for):
        self.kind = kind
        self.answer = None
        self.__dict__.update(asked_for)

    def apply(self, state, found):
        """Changes the state; False where this cannot have happened in it."""
        if self.kind == "add":
            return self.apply_add(state)
        if self.kind in ("edit", "undo", "redo"):
            return self.apply_to_map(state)
        draft = state.drafts.get(self.draft)
        if draft is None or (self.kind != "discard" and draft["version"] != self.version):
            return False
        if self.kind == "discard":
            del state.drafts[self.draft]
            return True
        if self.kind == "publish":
            return self.apply_publish(state, draft, found)
        if self.answer:  # it was told whole; that it is what was asked for, was looked at then
            draft["log"] = log_of(self.answer["edits"])
        elif self.kind == "draft_edit":
            add(draft["log"], [asked(one) for one in self.edits])
        elif not (undo if self.kind == "draft_undo" else redo)(draft["log"]):
            return False
        draft["version"] += 1
        return True

    def apply_add(self, state):
        if self.answer:
            state.drafts[self.answer["id"]] = {"name": self.name, "version": 1, "log": []}
        else:
            state.unnamed.append(self.name)
        return True

    def apply_to_map(self, state):
        if state.revision != self.revision:
            return False
        if self.kind == "edit":
            add(state.log, [asked(one) for one in self.edits])
        elif not (undo if self.kind == "undo" else redo)(state.log):
            return False
        state.revision += len(self.edits) if self.kind == "edit" else 1
        return not self.answer or self.answer["revision"] == state.revision

    def apply_publish(self, state, draft, found):
        standing = [one["known"] for one in draft["log"] if not one["undone"]]
        if self.leave_out_lost:
            standing = self.kept(state, standing, found)
        if not standing:
            return False
        add(state.log, [of_draft(one) for one in standing])
        state.revision += 1
        del state.drafts[self.draft]
        return not self.answer or self.answer["revision"] == state.revision

    def kept(self, state, standing, found):
        """Those of the standing edits that the map took. Known where it was at the revision at which the draft was looked at;
        else any that are there in their order."""
        if self.seen["revision"] == state.revision:
            return [detail(one) for one in self.seen["edits"] if not one["undone"] and one["lost"] is None]
        change = next_change(state.log)
        there = [detail(one) for one in found.history if one["change"] == change]
        rest = iter(standing)
        in_order = all(any(all(real[field] == value for field, value in of_draft(one).items()) for one in rest) for real in there)
        return there if in_order else []


class Ledger:
    """Thread-safe. `requests`: of each caller what was acknowledged since `state`, and last what is in flight."""

    def __init__(self, found, in_flight):
        self.lock = threading.Lock()
        self.state = State(found.revision, found.history, found.drafts.values())
        self.requests = {"editor": [], "drafter": []}
        self.seen_edits = {}   # (change, number in it): what some caller has read of it
        self.seen_graphs = {}  # (what, version, revision): as some caller has read it
        self.in_flight = in_flight  # counts

    def sent(self, caller, request):
        with self.lock:
            self.requests[caller].append(request)

    def answered(self, caller, request, answer):
        """`answer`: None where it was refused."""
        with self.lock:
            if answer is None:
                self.requests[caller].remove(request)
            else:
                request.answer = answer

    def read_history(self, edits):
        with self.lock:
            self.seen_edits.update(self.numbered(edits))

    def read_graph(self, graph, what="map", version=0):
        with self.lock:
            self.seen_graphs[what, version, graph["revision"]] = graph

    @staticmethod
    def numbered(edits):
        numbers, told = {}, {}
        for one in edits:
            numbers[one["change"]] = numbers.get(one["change"], -1) + 1
            told[one["change"], numbers[one["change"]]] = detail(one)
        return told

    def possible(self, found, state, editor, drafter):
        """All that may be there, and which requests in flight came through for it."""
        if not editor and not drafter:
            yield state, 0
            return
        for queue, other, is_editor in ((drafter, editor, False), (editor, drafter, True)):
            if not queue:
                continue
            request, rest = queue[0], queue[1:]
            after = copy.deepcopy(state)
            if request.apply(after, found):
                pair = (rest, other) if is_editor else (other, rest)
                for end, came in self.possible(found, after, *pair):
                    yield end, came + (request.answer is None)
            if request.answer is None:
                pair = (rest, other) if is_editor else (other, rest)
                yield from self.possible(found, state, *pair)
            elif request.kind not in ("edit", "undo", "redo", "publish"):
                return  # of a draft alone: its place among the others does not matter

    def differences(self, found):
        """What is not as it was acknowledged; what is there counts from now on."""
        told = []
        with self.lock:
            queues = self.requests["editor"], self.requests["drafter"]
            flying = sum(request.answer is None for queue in queues for request in queue)
            reasons = ["what was acknowledged cannot have happened in any order"]
            for state, came in self.possible(found, self.state, *queues):
                reason = state.difference(found)
                if reason is None:
                    reasons = []
                    self.in_flight["came through"] += came
                    self.in_flight["did not"] += flying - came
                    break
                reasons.append(reason)
            told += reasons[-1:]
            now = self.numbered(found.history)
            told += [f"edit {key} was {one} when it was read, and is {now.get(key)}"
                     for key, one in self.seen_edits.items() if now.get(key) != one]
            if told:
                told.append({"requests": [{**vars(request), "seen": None} for queue in queues for request in queue],
                             "expected": vars(self.state), "found": {"revision": found.revision, "history": found.history,
                                                                     "drafts": list(found.drafts.values())}})
            told += self.other_graph(found.graph, "map", 0)
            self.state = State(found.revision, found.history, found.drafts.values())
            self.requests = {"editor": [], "drafter": []}
            self.seen_edits = now
        return told

    def other_graph(self, graph, what, version):
        before = self.seen_graphs.get((what, version, graph["revision"]))
        if before in (None, graph):
            return []
        return [f"the graph of {what} is another one at revision {graph['revision']}: "
                f"{[key for key in graph if graph[key] != before[key]]}", {"before": before, "after": graph}]

    def other_draft_graph(self, draft, graph):
        with self.lock:
            return self.other_graph(graph, draft["id"], draft["version"])

    def forget_graphs(self):
        with self.lock:
            self.seen_graphs.clear()
