// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { lineLook } from './line_look';

const kOpen = { weak: false, closed: 'no', shortcut: false } as const;

describe('the look of a way', () => {
  it('is plain where nothing is to be said', () => {
    expect(lineLook(kOpen, null)).toEqual({
      colour: 'line-strong',
      dash: 'solid',
      width: 1,
      rank: 0,
      sign: null,
      text: 'ink',
    });
  });

  it('tells a weak way, a shortcut and one that waits for a decision', () => {
    expect(lineLook({ ...kOpen, weak: true }, null).dash).toBe('dashed');
    expect(lineLook({ ...kOpen, shortcut: true }, null)).toMatchObject({ colour: 'focus', dash: 'solid' });
    expect(lineLook({ ...kOpen, shortcut: true, proposed: true }, null)).toMatchObject({
      colour: 'focus',
      dash: 'dashed',
      width: 0.7,
    });
  });

  it('tells a closed way, with a cross where it is closed to both sides', () => {
    expect(lineLook({ ...kOpen, closed: 'one_way' }, null)).toMatchObject({ dash: 'dotted', sign: null });
    expect(lineLook({ ...kOpen, weak: true, closed: 'both' }, null)).toMatchObject({
      colour: 'danger',
      dash: 'dotted',
      sign: '✕',
    });
  });

  it('tells the way ahead of a robot, but not instead of that it is closed or other', () => {
    expect(lineLook({ ...kOpen, weak: true }, null, true)).toMatchObject({ colour: 'brand', width: 2.4 });
    expect(lineLook({ ...kOpen, closed: 'both' }, null, true)).toMatchObject({
      colour: 'danger',
      width: 2.4,
      sign: '✕',
    });
    expect(lineLook(kOpen, 'removed', true)).toEqual(lineLook(kOpen, 'removed'));
  });

  it('says first of all what a draft makes other', () => {
    expect(lineLook({ ...kOpen, closed: 'both' }, 'changed')).toMatchObject({ colour: 'amber', sign: '≠' });
    expect(lineLook(kOpen, 'added')).toMatchObject({ colour: 'brand', dash: 'solid', sign: '+' });
    expect(lineLook(kOpen, 'removed')).toMatchObject({ colour: 'danger', dash: 'dashed', sign: '−' });
  });
});
