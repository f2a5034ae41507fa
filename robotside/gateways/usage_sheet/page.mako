<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width,initial-scale=1">
<title>${sheet.name}</title>
<%include file="style.mako"/>
</head>
<body>
<header><div>
<h1>${sheet.name}</h1>
<form method="post" action="/stop"><button class="stop">STOP</button></form>
</div>
% if sheet.stopped:
<p class="stopped" role="status">${sheet.stopped}</p>
% endif
</header>
<main>
<p>${sheet.about} ${sheet.state}</p>

<h2>In the app</h2>
% if parts.offer:
<section class="card app">${parts.offer | n}</section>
% else:
<section class="card app">
% if parts.link:
<div class="qr">${parts.qr | n}</div>
<div><p>Scan this with the phone's camera, or open <a href="${parts.link}">this link</a>, to connect.</p>
<p class="quiet">Its address: <code>${parts.address}</code></p></div>
% else:
<div><p>The app on this computer connects to <code>${parts.address}</code>.</p>
<p class="quiet">No other machine reaches this robot: <code>python -m robotside serve --host 0.0.0.0 --pair</code> lets phones in.</p></div>
% endif
% if parts.pairs:
<p class="quiet">Pairing is closed. A paired handheld that manages the robot opens it, or <code>python -m robotside pair</code> on the
robot's computer.</p>
% endif
</section>
% endif

% if parts.cameras:
<h2>Cameras</h2>
<ul class="cameras">${parts.cameras | n}</ul>
% endif

<h2>Protocols</h2>
<details>
<summary>rosbridge <span class="quiet">Pilothouse, roslibjs, roslibpy, Foxglove</span></summary>
<p>A WebSocket at <code>${sheet.bridge}</code>. Each message below, under what the robot has, can be sent as it stands.</p>
<p>In Python:</p>
<pre class="python">${sheet.program}</pre>
</details>
<details>
<summary>HTTP <span class="quiet">browsers, curl</span></summary>
% for command in sheet.commands:
<p class="quiet">${command.doc}</p>
<pre class="shell">${command.line}</pre>
% endfor
</details>
% for gateway in sheet.gateways:
<details>
<summary>${gateway.name} <span class="quiet">${gateway.doc}</span>${' – not reached' if gateway.fault else ''}</summary>
<p><code>${gateway.url}</code></p>
% if gateway.fault:
<p class="fault">${gateway.fault}</p>
% endif
<pre class="guide" data-gateway="${gateway.name}">${gateway.guide}</pre>
</details>
% endfor
<p class="quiet">The same as text: <a href="/usage.txt">/usage.txt</a>. Health: <a href="/healthz">/healthz</a>.</p>

<h2>What it has</h2>
% for each in sheet.payloads:
<details>
<summary>${each.payload.key} <span class="quiet">${each.payload.doc}</span></summary>
% for line in each.lines:
<div class="line"><span class="tag">${line.verb}</span> <span class="name">${line.name}</span>
<p class="quiet">${line.doc}${'.' if line.doc else ''} ${rate(line)}${';' if rate(line) else ''} ${line.type}${'; ' + line.units if line.units else ''}</p>
<pre class="rosbridge">${message(line)}</pre></div>
% endfor
</details>
% endfor
% if sheet.services:
<details>
<summary>more services <span class="quiet">for programs with a session of their own</span></summary>
<table>
% for name, type in sheet.services:
<tr><td>${name}</td><td class="quiet">${type}</td></tr>
% endfor
</table>
</details>
% endif
</main>
</body>
</html>
