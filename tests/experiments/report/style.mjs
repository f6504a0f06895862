export const style = `
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0; background: #fff; color: #1c1c22; font: 16px/1.55 system-ui, sans-serif; }
main { max-width: 1080px; margin: 0 auto; padding: 24px 20px 80px; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0.4em 0; }
h2 { font-size: 1.4rem; margin: 2.6em 0 0.5em; padding-top: 0.5em; border-top: 2px solid #d9d9e0; }
h3 { font-size: 1rem; margin: 1.2em 0 0.2em; }
.findings h3 { margin-top: 0; }
p { max-width: 76ch; margin: 0.6em 0; }
a { color: #0b5fa5; }
.lead { font-size: 1.08rem; }
.note, figcaption { color: #51515c; font-size: 0.9rem; }
nav ol { columns: 2 320px; padding-left: 1.4em; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: 0.8em 0; font-size: 0.92rem; }
th, td { padding: 4px 12px 4px 0; border-bottom: 1px solid #e2e2e8; text-align: left; vertical-align: top; }
th { border-bottom: 2px solid #9a9aa6; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.findings { display: grid; grid-template-columns: repeat(auto-fit, minmax(290px, 1fr)); gap: 14px; margin: 1em 0; }
.findings > div { background: #f5f6fa; border-left: 4px solid #9a9aa6; padding: 10px 14px; }
.findings > div + div { border-left-color: #0072b2; }
.findings p { margin: 0; }
figure { margin: 0; }
figure.block { margin: 1.2em 0; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(var(--least), 46%), 1fr)); gap: 12px; }
.picture img { width: 100%; height: auto; display: block; }
.plot { width: 100%; min-width: 480px; height: auto; display: block; }
.plot text { font: 12px system-ui, sans-serif; fill: #33333b; }
.plot .grid { stroke: #e6e6ec; }
.plot .axis { stroke: #77777f; }
.legend { display: flex; flex-wrap: wrap; gap: 4px 18px; font-size: 0.88rem; margin: 0.3em 0; }
.legend i { display: inline-block; width: 22px; border-top: 3px solid var(--c); vertical-align: middle; margin-right: 6px; }
.legend i.dashed { border-top-style: dashed; }
.legend i.dot { width: 10px; height: 10px; border: 0; border-radius: 50%; background: var(--c); }
.multiples { display: grid; grid-template-columns: repeat(auto-fill, minmax(300px, 1fr)); gap: 10px; }
.multiples .plot { min-width: 0; }
.verdict { font-weight: 600; white-space: nowrap; }
.confirmed { color: #14713c; } .passed { color: #0b5fa5; } .missed { color: #b3261e; } .open { color: #6b6b76; }
@media (max-width: 520px) { body { font-size: 15px; } main { padding: 14px 12px 60px; } }
`;
