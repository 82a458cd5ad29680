// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Graph, MapInfo } from '../../api/types';
import { Loading } from '../../components/loading';
import { Notice } from '../../components/notice';
import { useLoaded } from '../../lib/loaded';
import { follow } from '../../lib/router';
import { BuildAgain } from '../tours/build_again';

/** What the latest build says of itself, as whoever hands a map over signs it: to read, and to print. */
export function ReportPage({ map, graph, mayEdit }: { map: MapInfo; graph: Graph; mayEdit: boolean }) {
  const report = useLoaded(() => calls.askReport(map.id), graph.revision);
  if (report.problem?.status === 404)
    return (
      <>
        <Notice still>
          There is no report of this map. {report.problem.message} Build it here from its tours, under{' '}
          <a href="/tours" onClick={follow}>
            Tours
          </a>
          .
        </Notice>
        {mayEdit && <BuildAgain map={map} />}
      </>
    );
  return (
    <>
      <Loading of={report} what="The report">
        {() => <Report key={graph.revision} map={map} />}
      </Loading>
      {mayEdit && <BuildAgain map={map} />}
    </>
  );
}

function Report({ map }: { map: MapInfo }) {
  const frame = useRef<HTMLIFrameElement>(null);
  const [height_px, setHeight] = useState<number | null>(null);
  const [sizes] = useState(() => new ResizeObserver(([one]) => one && setHeight(heightOf(one.target))));
  useEffect(() => () => sizes.disconnect(), [sizes]);
  // The page in the frame has no scripts; it is as high as what is in it, so that nothing scrolls inside the page.
  const watch = () => {
    const inner = frame.current?.contentDocument;
    if (!inner) return;
    inner.addEventListener('keydown', stopToo, { capture: true });
    const { body } = inner;
    sizes.disconnect();
    sizes.observe(body);
    setHeight(heightOf(body));
  };
  return (
    <>
      <div class="row apart">
        <p class="soft">
          What the latest build found. What people changed since then, and tours that were added, are not in
          it. It is for whoever accepts the map.
        </p>
        <div class="row">
          <button type="button" class="button main" onClick={() => frame.current?.contentWindow?.print()}>
            Print
          </button>
          <a class="button" href={calls.reportUrl(map.id)} target="_blank" rel="noopener">
            Open on its own<span class="hidden-text"> in a new tab</span>
          </a>
        </div>
      </div>
      <iframe
        ref={frame}
        class="report"
        title={`Report of the map ${map.name}`}
        src={calls.reportUrl(map.id)}
        sandbox="allow-same-origin allow-modals"
        style={height_px === null ? undefined : { height: `${height_px}px` }}
        onLoad={watch}
      />
    </>
  );
}

/** Escape stops the chair also where the keyboard is in the frame. */
function stopToo({ key, repeat }: KeyboardEvent): void {
  if (key === 'Escape') dispatchEvent(new KeyboardEvent('keydown', { key, repeat, cancelable: true }));
}

const kFrameEdge_px = 2;

function heightOf(body: Element): number {
  return body.ownerDocument.documentElement.scrollHeight + kFrameEdge_px;
}
