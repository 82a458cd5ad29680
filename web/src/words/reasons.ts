// SPDX-License-Identifier: Apache-2.0
import english from '../../../proto/reasons.en.json';
import contract from '../../../proto/reasons.json';
import { sentence } from '../api/problem';
import type { Reason } from '../api/types';

/** The codes of proto/reasons.json, each with its sentence. */
export type ReasonCode = keyof typeof english.reasons;

/** What a language says: proto/reasons.<language>.json. What a translation lacks is said in English. */
export interface Catalogue {
  language: string;
  words: { between: string; last: string; destination: string };
  reasons: Partial<Record<ReasonCode, string>>;
}

/** All languages that there is a file of, found when the dashboard is built. */
const kCatalogues: readonly Catalogue[] = Object.values(
  import.meta.glob<Catalogue>('../../../proto/reasons.*.json', { eager: true, import: 'default' }),
);

/** The catalogue of the first of these languages that there is one of; else English. */
export function catalogueFor(languages: readonly string[]): Catalogue {
  for (const language of languages) {
    const found = kCatalogues.find((one) => one.language === language.split('-')[0]);
    if (found) return found;
  }
  return english;
}

const kForms = ['zero', 'one', 'two', 'few', 'many', 'other'] as const;

/** Of the forms of a word, in the order of Unicode's plural categories, the one that fits a count. */
function formFor(count: number, forms: readonly string[], language: string): string {
  const rules = new Intl.PluralRules(language);
  const known = kForms.filter((form) => rules.resolvedOptions().pluralCategories.includes(form));
  return forms[known.indexOf(rules.select(count))] ?? forms.at(-1) ?? '';
}

type Parameter = Reason['parameters'][string];

function isReason(value: unknown): value is Reason {
  return typeof value === 'object' && value !== null && 'code' in value && 'parameters' in value;
}

const kCodes: Readonly<Record<string, { parameters: Readonly<Record<string, string>> } | undefined>> =
  contract.codes;

function valueWords(type: string | undefined, value: Parameter, catalogue: Catalogue): string {
  if (typeof value === 'number') return String(value);
  if (typeof value === 'string')
    return type === 'destination' && value === '' ? catalogue.words.destination : value;
  if (!Array.isArray(value)) return isReason(value) ? reasonWords(value, catalogue) : '';
  const items = value.filter(isReason).map((item) => reasonWords(item, catalogue));
  const { between, last } = catalogue.words;
  if (type === 'series' || items.length < 2) return items.join(between);
  return items.slice(0, -1).join(between) + last + (items.at(-1) ?? '');
}

/** What a reason says, word for word as its catalogue has it. */
export function reasonWords(reason: Reason, catalogue: Catalogue): string {
  const code = reason.code as ReasonCode;
  const template: string | undefined =
    catalogue.reasons[code] ?? (english.reasons as Catalogue['reasons'])[code];
  if (template === undefined) return reason.code.replaceAll('_', ' ');
  return template.replace(/\{([a-z_]+)(?:\?([^}]*))?\}/g, (_all, name: string, forms: string | undefined) => {
    const value = reason.parameters[name];
    if (value === undefined) return '';
    if (forms === undefined) return valueWords(kCodes[code]?.parameters[name], value, catalogue);
    return formFor(Number(value), forms.split(':'), catalogue.language);
  });
}

/** What a reason says in the language of whoever reads this page. */
export function reasonText(reason: Reason): string {
  const languages = typeof navigator === 'undefined' ? [] : navigator.languages;
  return reasonWords(reason, catalogueFor(languages));
}

/** The same as a sentence, also where a person's own words are none. */
export function reasonSentence(reason: Reason): string {
  return sentence(reasonText(reason));
}
