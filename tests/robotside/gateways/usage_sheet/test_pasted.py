"""What a line for a shell has in it that reaches a robot with TLS, and one without."""

from __future__ import annotations

from robotside.gateways.usage_sheet.pasted import PLAIN, RobotKey, curl, is_secure, without_tls


def test_behind_tls_curl_knows_the_robot_by_its_key_and_shows_a_token() -> None:
    said = " -k --pinnedpubkey sha256//pin= -H 'Authorization: Bearer TOKEN'"
    assert curl("https://192.0.2.7:8080/api", RobotKey("pin=")) == said
    assert "-k" not in curl("https://192.0.2.7:8080/api", PLAIN), "-k alone would trust anybody"
    assert curl("http://127.0.0.1:8080/api", RobotKey("pin=")) == ""


def test_stop_is_pressed_without_tls_by_anyone() -> None:
    assert without_tls("https://[2001:db8::7]:8080/soap") == "http://[2001:db8::7]:8080/soap"
    assert without_tls("http://h:1/api") == "http://h:1/api"
    assert is_secure("https://h:1")
    assert not is_secure("http://h:1")
