// SPDX-License-Identifier: Apache-2.0
import type { ComponentChildren } from 'preact';
import { useState } from 'preact/hooks';

interface Props {
  title: string;
  about?: string; // to what it belongs, for those who do not see what it stands beside
  heading?: boolean; // whether the title is one
  begun?: boolean; // open from the start
  children: ComponentChildren;
}

/** A part of a card that opens on a press; what is in it is made then. */
export function Section({ title, about, heading = true, begun = false, children }: Props) {
  const [open, setOpen] = useState(begun);
  const words = (
    <>
      {title}
      {about && <span class="hidden-text"> {about}</span>}
    </>
  );
  return (
    <details class="section" open={open} onToggle={(event) => setOpen(event.currentTarget.open)}>
      <summary>{heading ? <h4>{words}</h4> : <span>{words}</span>}</summary>
      {open && <div class="stack section-body">{children}</div>}
    </details>
  );
}
