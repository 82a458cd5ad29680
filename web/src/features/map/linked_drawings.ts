// SPDX-License-Identifier: Apache-2.0
import type { Core } from 'cytoscape';

/** Drawings that show the same part: who moves or enlarges one does so with all. */
export class LinkedDrawings {
  private readonly drawings = new Set<Core>();
  private moving = false;

  /** Takes on what the others show; returns its end. */
  join(drawing: Core): () => void {
    const [first] = this.drawings;
    if (first) drawing.viewport({ zoom: first.zoom(), pan: { ...first.pan() } });
    const follow = () => this.moveTo(drawing);
    drawing.on('viewport', follow);
    this.drawings.add(drawing);
    return () => {
      drawing.off('viewport', follow);
      this.drawings.delete(drawing);
    };
  }

  private moveTo(leader: Core): void {
    if (this.moving) return; // a movement that follows leads no further
    this.moving = true;
    for (const one of this.drawings)
      if (one !== leader) one.viewport({ zoom: leader.zoom(), pan: { ...leader.pan() } });
    this.moving = false;
  }
}
