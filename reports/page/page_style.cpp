#include "reports/page/page_style.h"

namespace reports {

std::string pageStyle()
{
    return R"css(
:root { --ink:#22303a; --soft:#5b6770; --line:#d9dfe3; --paper:#ffffff; --wash:#f5f7f8; --accent:#1d4e63; --warn:#8a3b00;
  --warnwash:#fff1e3; }
* { box-sizing:border-box; }
html { -webkit-text-size-adjust:100%; }
body { margin:0; background:var(--wash); color:var(--ink);
  font:16px/1.55 "Source Sans 3","Segoe UI","Helvetica Neue","Liberation Sans",Arial,sans-serif; }
main, header.top, nav, footer { max-width:1080px; margin:0 auto; padding:0 32px; }
header.top { padding-top:44px; padding-bottom:8px; }
h1 { font:600 34px/1.2 "Source Serif 4",Georgia,"Liberation Serif",serif; margin:0 0 6px; letter-spacing:-.01em; }
h2 { font:600 23px/1.25 "Source Serif 4",Georgia,"Liberation Serif",serif; margin:0; color:var(--accent); }
h3 { font-size:16px; margin:26px 0 8px; }
p { margin:.5em 0 .8em; max-width:76ch; }
.lede { color:var(--soft); font-size:17px; margin:0; }
nav { display:flex; flex-wrap:wrap; gap:4px 18px; padding-top:12px; padding-bottom:14px; font-size:15px; }
a { color:var(--accent); text-underline-offset:3px; }
a:focus-visible, summary:focus-visible { outline:3px solid #56b4e9; outline-offset:2px; }
section { background:var(--paper); border:1px solid var(--line); border-radius:10px; padding:26px 30px 22px; margin:0 0 22px; }
.head { display:flex; flex-wrap:wrap; align-items:center; gap:8px 14px; margin:0 0 10px; }
.tag { font-size:12.5px; font-weight:700; letter-spacing:.04em; border-radius:999px; padding:2px 11px;
  border:1px solid; white-space:nowrap; }
.tag.simulated { color:var(--warn); background:var(--warnwash); border-color:#e2a675; }
.tag.blinded { color:#3d3566; background:#eeecfa; border-color:#b3abdc; }
.notice { border-left:5px solid #d55e00; background:var(--warnwash); padding:10px 16px;
  border-radius:4px; margin:12px 0 0; max-width:none; }
.notice.plain { border-color:#56718a; background:#eaf0f4; }
.tiles { display:grid; grid-template-columns:repeat(auto-fit,minmax(135px,1fr)); gap:10px; margin:6px 0 16px; }
.tile { border:1px solid var(--line); border-radius:8px; padding:10px 14px; }
.tile b { display:block; font:600 24px/1.2 "Source Serif 4",Georgia,"Liberation Serif",serif; }
.tile span { color:var(--soft); font-size:14px; }
ul.findings { padding-left:20px; margin:.4em 0 .6em; } ul.findings li { margin:.35em 0; max-width:84ch; }
figure { margin:14px 0 6px; } figure svg { height:auto; max-width:min(100%, 960px); display:block; margin:0 auto; }
figure .narrow { display:none; } figure .narrow svg { max-width:min(100%, 490px); }
figcaption { color:var(--soft); font-size:14.5px; max-width:84ch; margin:6px auto 0; }
.scroll { overflow-x:auto; margin:14px 0 4px; }
table { border-collapse:collapse; width:100%; font-size:14.5px; font-variant-numeric:tabular-nums; }
caption { text-align:left; color:var(--soft); padding:0 0 8px; font-size:14.5px; }
thead th { text-align:left; border-top:2px solid var(--ink); border-bottom:1px solid var(--ink); padding:7px 6px;
  vertical-align:bottom;  font-weight:600; line-height:1.25; }
tbody th { text-align:left; font-weight:400; } tbody th, tbody td { padding:5px 6px; border-bottom:1px solid #eaeef0; }
tbody tr:last-child > * { border-bottom:2px solid var(--ink); }
.n { text-align:right; } tbody .n { white-space:nowrap; } .sd { color:var(--soft); }
.cond { white-space:nowrap; font-size:1.06em; font-family:"Source Serif 4",Georgia,"Liberation Serif",serif; }
sub { font-size:.74em; line-height:0; }
details { margin:12px 0 0; border:1px solid var(--line); border-radius:8px; padding:8px 14px; }
summary { cursor:pointer; font-weight:600; } details[open] summary { margin-bottom:4px; }
.small { color:var(--soft); font-size:14.5px; }
footer { color:var(--soft); font-size:14px; padding-top:6px; padding-bottom:46px; }
@media (max-width:640px) { main, header.top, nav, footer { padding-left:14px; padding-right:14px; }
  section { padding:18px 14px; } figure .wide { display:none; } figure .narrow { display:block; } }
@media print { body { background:#fff; font-size:11pt; } nav { display:none; } section { border:0; border-top:1px solid #999;
  border-radius:0; padding:12px 0; } figure, table { break-inside:avoid; } h2 { break-after:avoid; }
  h1, h2, h3, .head, caption, summary { break-after:avoid; } summary { list-style:none; } details { border:0; padding:0; }
  details::details-content { content-visibility:visible; display:block; height:auto; }
  figure .wide { display:block; } figure .narrow { display:none; } .scroll { overflow:visible; } table { font-size:9pt; } tbody th, tbody td { padding:2px 6px; } }
)css";
}

}  // namespace reports
