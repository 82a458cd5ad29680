// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace homeward::pipeline {

/// How a report looks, on screens of all widths and on paper.
inline constexpr const char* kReportStyle = R"css(
:root { color-scheme: light; --ink: #1d2429; --soft: #56616b; --line: #d9dee3; --paper: #ffffff; --wash: #f5f7f9;
  --yes: #157347; --no: #b3261e; --open: #8a5300; --blue: #1f5f99; }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0 auto; padding: 2.5rem 1.5rem 4rem; max-width: 66rem; background: var(--paper); color: var(--ink);
  font: 1rem/1.55 system-ui, "Segoe UI", "Noto Sans", "DejaVu Sans", sans-serif; font-variant-numeric: tabular-nums; }
h1 { font-size: 2.1rem; line-height: 1.15; margin: 0; letter-spacing: -0.02em; overflow-wrap: anywhere; }
h2 { font-size: 1.35rem; margin: 3rem 0 0.4rem; padding-top: 0.8rem; border-top: 1px solid var(--line); letter-spacing: -0.01em; }
h3 { font-size: 1.05rem; margin: 1.8rem 0 0.5rem; }
p { margin: 0.5rem 0; max-width: 50rem; }
header p { max-width: none; }
.kicker { margin: 0 0 0.3rem; color: var(--soft); font-size: 0.85rem; letter-spacing: 0.08em; text-transform: uppercase; }
.soft, figcaption { color: var(--soft); font-size: 0.9rem; }
nav ul { list-style: none; margin: 1.4rem 0 0; padding: 0; display: flex; flex-wrap: wrap; gap: 0.3rem 1.2rem; font-size: 0.92rem; }
a { color: var(--blue); }
a:focus-visible { outline: 3px solid var(--blue); outline-offset: 2px; }
dl.tiles { display: grid; grid-template-columns: repeat(5, 1fr); gap: 0.7rem; margin: 1.4rem 0; }
dl.tiles div { background: var(--wash); border-radius: 0.5rem; padding: 0.7rem 0.9rem; }
dl.tiles dt { color: var(--soft); font-size: 0.85rem; line-height: 1.3; }
dl.tiles dd { margin: 0.1rem 0 0; font-size: 1.7rem; line-height: 1.15; font-weight: 600; }
ul.todo { margin: 0.8rem 0; padding: 0; list-style: none; max-width: 46rem; }
ul.todo li { padding: 0.5rem 0.9rem; margin: 0.4rem 0; background: #fdf4e7; border-left: 4px solid #c27803; }
ul.todo li.good { background: #eaf6ef; border-left-color: var(--yes); }
figure { margin: 1rem 0; }
.scroll { overflow-x: auto; }
svg { display: block; width: 100%; height: auto; font-family: inherit; }
svg.wide { min-width: 44rem; }
svg.matrix { max-width: 40rem; min-width: 20rem; }
svg.bars { max-width: 32rem; }
svg .edge { stroke: #8d99a4; stroke-width: 1.6; }
svg .edge.weak { stroke: var(--no); stroke-width: 2.6; stroke-dasharray: 6 4; }
svg .edge.blocked { stroke: var(--ink); stroke-width: 2; stroke-dasharray: 1.5 4; }
svg .place { fill: #e3effa; stroke: var(--blue); stroke-width: 1.4; }
svg .place.twice { fill: #8fbfe6; }
svg .place.often { fill: #2b6ca8; }
svg text { fill: var(--ink); font-size: 12px; }
svg text.id { fill: var(--soft); font-size: 10px; paint-order: stroke; stroke: #ffffff; stroke-width: 2px; }
svg text.name { font-size: 16px; font-weight: 650; paint-order: stroke; stroke: #ffffff; stroke-width: 3px; stroke-linejoin: round; }
svg text.axis { fill: var(--soft); font-size: 12px; }
svg .tick, svg .frame { stroke: #9aa5ae; stroke-width: 1; fill: none; }
svg .lead { stroke: #9aa5ae; stroke-width: 1; stroke-dasharray: 2 2; }
svg .seam { stroke: var(--ink); stroke-width: 1.5; }
svg .arc { fill: none; }
svg .arc.accepted { stroke: var(--yes); stroke-width: 1.5; }
svg .arc.undecided { stroke: #c27803; stroke-width: 1.5; stroke-dasharray: 5 3; }
svg .arc.rejected { stroke: var(--no); stroke-width: 1; stroke-opacity: 0.35; }
svg .bar { fill: #2b6ca8; }
svg.masses { display: inline-block; width: 100%; height: 0.75rem; vertical-align: middle; border-radius: 2px; }
svg .for { fill: var(--yes); }
svg .unknown { fill: #d5dade; }
svg .against { fill: var(--no); }
ul.legend { list-style: none; margin: 0.4rem 0; padding: 0; display: flex; flex-wrap: wrap; gap: 0.2rem 1.4rem; font-size: 0.88rem; color: var(--soft); }
ul.legend svg { display: inline-block; width: 1.9rem; height: 0.8rem; margin-right: 0.4rem; vertical-align: -0.05rem; }
table { border-collapse: collapse; width: 100%; font-size: 0.9rem; }
th, td { text-align: left; padding: 0.35rem 0.7rem 0.35rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
th { color: var(--soft); font-weight: 600; }
td.n, th.n { text-align: right; white-space: nowrap; padding-right: 1.2rem; }
th.n { white-space: normal; }
.loops { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 27rem), 1fr)); gap: 1.2rem; margin: 1rem 0; }
.loop { border: 1px solid var(--line); border-radius: 0.5rem; padding: 0.8rem; break-inside: avoid; min-width: 0; }
.loop h4 { margin: 0 0 0.5rem; font-size: 0.95rem; line-height: 1.35; overflow-wrap: anywhere; }
.loop img { display: block; width: 100%; height: auto; border-radius: 0.25rem; }
.loop p { font-size: 0.88rem; line-height: 1.45; margin: 0.5rem 0 0; }
.loop table { font-size: 0.82rem; margin-top: 0.5rem; }
.loop table th, .loop table td { padding: 0.15rem 0.5rem 0.15rem 0; border: 0; vertical-align: middle; white-space: nowrap; }
.loop table td.bar { width: 99%; }
.badge { display: inline-block; padding: 0.05rem 0.5rem; border-radius: 1rem; font-size: 0.8rem; font-weight: 600; color: #ffffff; white-space: nowrap; }
.badge.accepted { background: var(--yes); }
.badge.rejected { background: var(--no); }
.badge.undecided { background: var(--open); }
.name { overflow-wrap: anywhere; }
@media (max-width: 48rem) { dl.tiles { grid-template-columns: repeat(3, 1fr); } }
@media (max-width: 30rem) { body { padding: 1.2rem 1rem 3rem; } h1 { font-size: 1.6rem; } dl.tiles { grid-template-columns: 1fr 1fr; } }
@media print {
  @page { size: A4; margin: 15mm 14mm 16mm; }
  * { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
  html { font-size: 8.8pt; } p { orphans: 3; widows: 3; } body { padding: 0; max-width: none; line-height: 1.42; }
  h1 { font-size: 22pt; } h2 { font-size: 13pt; margin-top: 7mm; } h2, h3, h4, h3 + p { break-after: avoid; }
  p, ul.todo { max-width: none; }
  nav { display: none; } a { color: inherit; text-decoration: none; }
  dl.tiles { grid-template-columns: repeat(5, 1fr); gap: 2mm; } dl.tiles dd { font-size: 14pt; }
  figure, tr, ul.todo li, .tile { break-inside: avoid; }
  .scroll { overflow: visible; } svg.wide, svg.matrix { min-width: 0; }
  svg.matrix { max-width: 125mm; } svg.wide text { font-size: 15px; } svg.wide text.id { font-size: 13px; }
  svg.wide text.name { font-size: 20px; }
  .loops { grid-template-columns: 1fr 1fr; gap: 3.5mm; } .loop { padding: 2mm 2.5mm; }
  .loop h4 { margin-bottom: 1mm; } .loop p { font-size: 0.82rem; line-height: 1.32; margin-top: 1mm; } .loop table { margin-top: 1mm; }
}
)css";

}  // namespace homeward::pipeline
