"""The examples' command lines where there is no robot: one sentence and exit code 1, by every protocol."""

from __future__ import annotations

import socket
import sys
from collections.abc import Iterator

import pytest

from examples import courier
from examples.protocols import __main__ as protocols
from examples.protocols.ways import PROTOCOLS
from tests.lacking import package


@pytest.fixture
def nobody() -> Iterator[str]:
    """An address of which this test has the port, and at which nobody listens."""
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        yield f"127.0.0.1:{taken.getsockname()[1]}"


def said(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], url: str) -> str:
    """What one call by `url` says, which cannot be done."""
    monkeypatch.setattr(sys, "argv", ["protocols", url, "/stop"])
    assert protocols.main() == 1
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    return err.strip()


WAYS = {
    "rosbridge": "ws://{}",
    "websocket": "websocket=ws://{}",
    "rest": "rest=http://{}/api",
    "soap": "soap=http://{}/soap",
    "mqtt": "mqtt://{}/robot",
}


@pytest.mark.parametrize("protocol", WAYS)
def test_where_nobody_listens_it_says_so(
    protocol: str, nobody: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    if protocol == "soap":
        package("zeep")
    url = WAYS[protocol].format(nobody)
    assert said(monkeypatch, capsys, url).lower() == f"{url} cannot be reached: connection refused."


WRONG = {
    "ftp://robot": "A way to a robot is coap=URL",
    "websocket=http://robot": "websocket=http://robot cannot be reached: http://robot isn't a valid URI",
    "ws://robot:port": "Port could not be cast to integer",
}


@pytest.mark.parametrize("url", WRONG)
def test_a_url_that_is_none_is_a_sentence(
    url: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert WRONG[url] in said(monkeypatch, capsys, url)


@pytest.mark.parametrize(
    ("protocol", "library", "package"), [("soap", "zeep", "zeep"), ("mqtt", "paho", "paho-mqtt")]
)
def test_a_library_that_is_not_installed_is_named_with_what_brings_it(
    protocol: str,
    library: str,
    package: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    for name in [f"examples.protocols.{protocol}", *sys.modules]:
        if name == f"examples.protocols.{protocol}" or name.partition(".")[0] == library:
            monkeypatch.delitem(sys.modules, name, raising=False)
    monkeypatch.setitem(sys.modules, library, None)
    url = f"{protocol}=x://robot"
    assert said(monkeypatch, capsys, url) == (
        f"{url} needs {library}, which is not installed: pip install {package} brings it."
    )


def test_the_courier_says_it_too(
    nobody: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["courier", "coffee", "--by", f"ws://{nobody}"])
    assert courier.main() == 1
    assert capsys.readouterr().err == f"ws://{nobody} cannot be reached: connection refused.\n"


def test_every_protocol_says_what_its_library_raises() -> None:
    for name in PROTOCOLS:
        if name == "soap":
            package("zeep")
        module = __import__(f"examples.protocols.{name}", fromlist=["OWN_FAULTS"])
        assert all(issubclass(each, Exception) for each in module.OWN_FAULTS)
