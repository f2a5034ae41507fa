<style>
:root{color-scheme:light dark;--ground:#f4f6f8;--card:#fff;--text:#17202a;--quiet:#5b6775;--line:#d8dfe6;--code:#eef2f6;--accent:#0b63c5;--alarm:#c40d1e}
@media(prefers-color-scheme:dark){:root{--ground:#11161c;--card:#1a2129;--text:#e8edf2;--quiet:#9aa7b4;--line:#2d3742;--code:#232c36;--accent:#6cb2ff;--alarm:#ff8a8a}}
*{box-sizing:border-box}
body{margin:0;background:var(--ground);color:var(--text);font:16px/1.5 system-ui,"Segoe UI",Roboto,"DejaVu Sans",sans-serif}
header{position:sticky;top:0;z-index:1;background:var(--card);border-bottom:1px solid var(--line)}
header>div,main{max-width:70rem;margin:0 auto;padding:.7rem 1rem}
header>div{display:flex;align-items:center;justify-content:space-between;gap:1rem}
.stopped{max-width:70rem;margin:0 auto;padding:0 1rem .6rem;font-weight:600;color:var(--alarm);overflow-wrap:anywhere}
h1{font-size:1.35rem;margin:0;overflow-wrap:anywhere}h2{font-size:1.15rem;margin:1.8rem 0 .6rem}h3{font-size:1rem;margin:0}
p{margin:.3rem 0 .6rem}a{color:var(--accent)}.fault{color:var(--alarm);font-weight:600}.quiet{color:var(--quiet);font-size:.92rem}
form{margin:0}button{font:inherit;cursor:pointer}
.stop{background:#c40d1e;color:#fff;border:0;border-radius:.5rem;font-weight:700;font-size:1.2rem;min-height:3rem;padding:.3rem 1.8rem;letter-spacing:.05em}
.stop:focus-visible,summary:focus-visible,a:focus-visible{outline:3px solid var(--accent);outline-offset:2px}
section.card,details{background:var(--card);border:1px solid var(--line);border-radius:.6rem;padding:.8rem 1rem;margin:0 0 .7rem}
summary{cursor:pointer;font-weight:600;overflow-wrap:anywhere}summary .quiet{font-weight:400}
details[open]>summary{margin-bottom:.6rem}
code,pre{font:.86rem/1.45 ui-monospace,"DejaVu Sans Mono",Menlo,Consolas,monospace;background:var(--code);border-radius:.35rem}
code{padding:.1em .35em;overflow-wrap:anywhere}
pre{margin:.3rem 0 .7rem;padding:.6rem .8rem;overflow-x:auto;white-space:pre;user-select:all}
pre.guide{max-height:32rem;overflow:auto;user-select:text}
.app{display:flex;flex-wrap:wrap;gap:1.2rem;align-items:center}.app>div{flex:1 1 16rem;min-width:0}
.app>.qr{flex:0 0 auto}.qr svg{display:block;width:13rem;height:13rem;border-radius:.4rem}.app>p{flex:1 0 100%;margin:0}
.code{font-size:1.5rem;font-weight:700;letter-spacing:.08em}
.line{border-top:1px solid var(--line);padding:.6rem 0 .1rem}
.line .name{font-weight:600;overflow-wrap:anywhere}.tag{display:inline-block;min-width:4.2rem;color:var(--accent);font-size:.85rem;font-weight:600}
.cameras{list-style:none;padding:0;display:grid;gap:1rem;grid-template-columns:repeat(auto-fit,minmax(min(100%,22rem),1fr))}
.cameras li{overflow-wrap:anywhere;background:var(--card);border:1px solid var(--line);border-radius:.6rem;padding:.8rem 1rem;font-size:.92rem}.cameras img{display:block;margin-top:.5rem;max-width:100%;height:auto;border-radius:.4rem;background:var(--code)}
table{border-collapse:collapse;width:100%}td,th{text-align:left;padding:.25rem .8rem .25rem 0;overflow-wrap:anywhere;vertical-align:top}
input{font:inherit;padding:.5rem;width:min(100%,30rem);border:1px solid var(--line);border-radius:.4rem;background:var(--card);color:inherit}
</style>
