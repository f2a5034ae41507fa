<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width,initial-scale=1">
<title>${name}</title>
<%include file="style.mako"/>
</head>
<body>
<header><div>
<h1>${name}</h1>
<form method="post" action="/stop"><button class="stop">STOP</button></form>
</div>
% if stopped:
<p class="stopped" role="status">${stopped}</p>
% endif
</header>
<main>
<section class="card"><p>${said}</p>
<form method="post" action="/login"><p><label>Token<br><input name="token" type="password" autocomplete="off"></label></p>
<button>Log in</button></form></section>
</main>
</body>
</html>
