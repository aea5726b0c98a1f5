// SPDX-License-Identifier: MIT
#include "firmware/deliver/report_style.h"

namespace plumbline::deliver {

const char* const kReportStyle = R"css(
:root { --ink: #1c2733; --soft: #5b6875; --line: #d8dee5; --paper: #fff; --wash: #f5f7f9;
  --blue: #1457a8; --orange: #c8500a; --grey: #8793a0; --good: #1d7a46; --caution: #a86a00;
  --bad: #b3261e; }
* { box-sizing: border-box; }
html { background: #e9edf1; }
body { margin: 0 auto; max-width: 1060px; padding: 44px 52px 60px; background: var(--paper);
  color: var(--ink); font: 15px/1.5 "Helvetica Neue", Helvetica, Arial, "Liberation Sans",
  "DejaVu Sans", sans-serif; font-variant-numeric: tabular-nums; }
header { display: flex; align-items: flex-start; gap: 18px; border-bottom: 2px solid var(--ink);
  padding-bottom: 18px; }
header svg { width: 30px; height: 62px; flex: none; }
.over { margin: 0; font-size: 12px; letter-spacing: .12em; text-transform: uppercase;
  color: var(--soft); }
h1 { margin: 2px 0 4px; font-size: 29px; line-height: 1.2; font-weight: 600;
  overflow-wrap: anywhere; }
.sub { margin: 0; color: var(--soft); font-size: 13.5px; }
h2 { margin: 40px 0 10px; font-size: 19px; font-weight: 600; break-after: avoid; }
p { margin: 8px 0; }
.verdict { margin: 24px 0 0; padding: 16px 20px; border-left: 6px solid; background: var(--wash); }
.verdict p { margin: 3px 0; }
.verdict .headline { font-size: 18.5px; font-weight: 600; }
.good { border-color: var(--good); } .caution { border-color: var(--caution); }
.bad { border-color: var(--bad); }
.good .mark { color: var(--good); } .caution .mark { color: var(--caution); }
.bad .mark { color: var(--bad); }
.mark { font-size: 11.5px; font-weight: 700; letter-spacing: .12em; text-transform: uppercase; }
.cards { display: grid; grid-template-columns: repeat(4, 1fr); gap: 1px; margin: 24px 0 0;
  background: var(--line); border: 1px solid var(--line); }
.card { padding: 12px 14px 11px; background: var(--paper); }
.card .name { color: var(--soft); font-size: 12px; }
.card .value { font-size: 22px; font-weight: 600; line-height: 1.3; white-space: nowrap; }
.card .more { color: var(--soft); font-size: 12px; line-height: 1.35; }
.missing { margin: 12px 0; padding: 13px 18px; border: 1px solid var(--caution);
  border-left-width: 6px; break-inside: avoid; }
.missing h3 { margin: 0 0 3px; font-size: 15.5px; color: var(--caution); }
.missing p { margin: 0; }
figure { margin: 22px 0 8px; break-inside: avoid; }
figure svg { display: block; width: 100%; height: auto; }
figcaption { margin-top: 8px; color: var(--soft); font-size: 13px; }
figcaption b { color: var(--ink); }
.scroll { overflow-x: auto; }
table { width: 100%; margin: 14px 0 6px; border-collapse: collapse; font-size: 12.5px;
  line-height: 1.35; }
caption { padding: 0 0 7px; text-align: left; font-size: 14px; font-weight: 600; }
thead { display: table-header-group; }
th { padding: 5px 8px; border-bottom: 1.5px solid var(--ink); text-align: left;
  vertical-align: bottom; font-weight: 600; }
th .unit { color: var(--soft); font-weight: 400; }
td { padding: 3.5px 8px; border-bottom: 1px solid var(--line); vertical-align: top; }
tr { break-inside: avoid; }
tr.total td { font-weight: 600; border-bottom-color: var(--ink); }
.reliance td:nth-child(2), .reliance td:nth-child(4) { white-space: nowrap; }
.number { text-align: right; white-space: nowrap; }
.inputs td { font-family: "DejaVu Sans Mono", Menlo, Consolas, monospace; font-size: 10.5px;
  overflow-wrap: anywhere; }
.note { color: var(--soft); font-size: 12.5px; }
ul { margin: 8px 0; padding-left: 20px; } li { margin: 4px 0; }
dl { display: grid; grid-template-columns: 150px 1fr; gap: 5px 16px; font-size: 13.5px; }
dt { font-weight: 600; } dd { margin: 0; }
footer { margin-top: 40px; padding-top: 10px; border-top: 1px solid var(--line);
  color: var(--soft); font-size: 12px; }
svg text { font-size: 13px; fill: var(--ink); }
svg .tick { fill: var(--soft); font-size: 12.5px; } svg .axis { fill: var(--soft); }
svg .label { font-size: 12px; } svg .middle { text-anchor: middle; }
svg .end { text-anchor: end; }
svg .halo { paint-order: stroke; stroke: #fff; stroke-width: 3px; stroke-linejoin: round; }
svg .ground { fill: #fbfcfd; stroke: var(--line); } svg .framed { stroke: var(--grey); }
svg .grid { stroke: #e3e8ed; stroke-width: 1; }
svg .bar { fill: var(--ink); stroke: var(--ink); stroke-width: 1; } svg .open { fill: #fff; }
svg .sigma-bar { stroke: var(--blue); stroke-width: 3; }
svg .ellipse { stroke-width: 1.2; } svg .ellipse.named { fill: #1457a826; stroke: var(--blue); }
svg .ellipse.tie { fill: none; stroke: #9fabb7; stroke-width: .9; }
svg .dots { fill: none; stroke-linecap: round; }
svg .dots.named { stroke: var(--blue); stroke-width: 5; }
svg .dots.tie { stroke: var(--grey); stroke-width: 2.6; }
svg .climb { fill: none; stroke: var(--orange); stroke-width: 1.4; stroke-dasharray: 4 3; }
svg .station { fill: var(--orange); stroke: #fff; stroke-width: 1; }
svg .fan { fill: #c8500a08; stroke: #c8500a66; stroke-width: .8; }
svg .height { stroke-width: 1.1; } svg .height.tie { stroke: #b4bec8; }
svg .height.named { stroke: var(--blue); stroke-width: 1.5; }
svg .north { fill: var(--ink); }
svg .arrows { fill: none; stroke: var(--blue); stroke-width: .9; }
svg .arrows.check { stroke: var(--bad); stroke-width: 1.5; }
svg .arrows.rejected { stroke: var(--bad); stroke-width: 1.2; }
@media (max-width: 720px) { body { padding: 22px 16px; }
  .cards { grid-template-columns: repeat(2, 1fr); } dl { grid-template-columns: 1fr; } }
@page { size: A4; margin: 14mm 13mm; }
@media print { html, body { background: none; } body { max-width: none; padding: 0;
    font-size: 10.5pt; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  .scroll { overflow: visible; } table { font-size: 8.2pt; } td, th { padding-left: 4px;
    padding-right: 4px; } h2 { margin-top: 26px; } .card .value { font-size: 15pt; } }
)css";

}  // namespace plumbline::deliver
