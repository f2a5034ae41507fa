"""Pages in browsers: the robot's own, allowed ones, and everybody else's."""

from __future__ import annotations

import logging
import socket

import pytest

from bridge.server.reception import pages
from bridge.server.reception.pages import PagePolicy, read_origin

HERE = ["127.0.0.1:9090"]


def policy(*allowed: str) -> PagePolicy:
    return PagePolicy(allowed, ["robot.example"], lambda: 8080)


@pytest.mark.parametrize(
    "host",
    [
        "127.0.0.1:9090",
        "localhost:9090",
        "LOCALHOST",
        "robot.localhost:1",
        "192.0.2.7:9090",
        "[::1]:9090",
        "[2001:db8::1]",
        "robot.example:9090",
        "robot.example.",
        f"{socket.gethostname()}:9090",
        f"{socket.gethostname().partition('.')[0]}.local",
    ],
)
def test_a_program_is_taken_by_any_name_of_this_robot(host: str) -> None:
    assert policy().judge([], [host]) == ("", True, True)


@pytest.mark.parametrize(
    "host",
    [
        "evil.example",
        "evil.example:9090",
        "127.0.0.1.evil.example",
        "localhost.evil.example",
        "",
        "a b",
        "[::1",
        "x@localhost",
    ],
)
def test_a_name_that_is_not_this_robots_is_refused(host: str) -> None:
    """So a page that has its own name resolved to this machine reaches nothing."""
    verdict = policy().judge([], [host])
    assert verdict.refusal
    assert not verdict.trusted
    assert policy().judge(["http://localhost:8080"], [host]).refusal


def test_two_hosts_or_two_origins_are_refused() -> None:
    assert policy().judge([], ["localhost", "localhost"]).refusal
    assert policy().judge(["http://localhost:8080"] * 2, HERE).refusal


@pytest.mark.parametrize(
    ("origin", "host"),
    [
        ("http://127.0.0.1:8080", "127.0.0.1:9090"),
        ("http://localhost:8080", "127.0.0.1:9090"),
        ("https://192.0.2.7:8080", "192.0.2.7:9090"),
        ("http://robot.example:8080", "robot.example:9090"),
        ("https://[2001:db8::1]:8080", "[2001:db8::1]:9090"),
    ],
)
def test_the_robots_own_page_is_trusted(origin: str, host: str) -> None:
    assert policy().judge([origin], [host]) == ("", True, True)


@pytest.mark.parametrize(
    "origin",
    [
        "https://evil.example",
        "http://evil.example:8080",
        "http://203.0.113.5:8080",
        "http://localhost:3000",
        "http://localhost",
        "null",
        "file://",
        "",
        "http://localhost:8080.evil.example",
        "http://localhost:8080@evil.example",
        "ftp://localhost:8080",
    ],
)
def test_any_other_page_is_refused(origin: str) -> None:
    verdict = policy().judge([origin], HERE)
    assert verdict.refusal
    assert not verdict.trusted


def test_without_a_web_site_there_is_no_own_page() -> None:
    assert PagePolicy().judge(["http://localhost"], HERE).refusal
    assert PagePolicy().judge(["http://localhost:0"], HERE).refusal


def test_a_page_that_is_allowed_counts_as_a_program_but_not_with_the_robots_cookie() -> None:
    assert policy("http://localhost:3000").judge(["http://localhost:3000"], HERE) == ("", True, False)
    assert policy("https://Tools.example:443/").judge(["https://tools.example"], HERE) == ("", True, False)
    assert policy("http://localhost:3000").judge(["http://localhost:3001"], HERE).refusal


def test_the_log_names_once_the_option_that_lets_a_page_in(caplog: pytest.LogCaptureFixture) -> None:
    judging = policy()
    for _ in range(3):
        judging.judge(["http://localhost:3000"], HERE)
    (line,) = [record.getMessage() for record in caplog.records]
    option = line.partition("--allow-origin ")[2].split()[0]
    assert not policy(option).judge(["http://localhost:3000"], HERE).refusal
    judging.judge([], ["robot.lab:9090"])
    option = caplog.records[-1].getMessage().partition("--allow-origin ")[2].split()[0]
    assert not policy(option).judge([], ["robot.lab:9090"]).refusal


def test_strangers_fill_neither_log_nor_memory(caplog: pytest.LogCaptureFixture) -> None:
    judging = policy()
    with caplog.at_level(logging.WARNING):
        for number in range(3 * pages.MAX_LOGGED):
            judging.judge([f"http://a{number}.example"], HERE)
            judging.judge(["\x1b[2J\n" + "x" * 10_000 + str(number)], HERE)
    assert len(caplog.records) <= pages.MAX_LOGGED
    assert all(
        "\x1b" not in record.getMessage() and "\n" not in record.getMessage() for record in caplog.records
    )


@pytest.mark.parametrize(
    "text",
    ["null", "", "localhost:3000", "http://", "http://a/b", "http://a:0", "http://a:99999", "http://a b"],
)
def test_an_option_that_is_no_origin_is_one_sentence(text: str) -> None:
    with pytest.raises(ValueError, match=r"\.$"):
        read_origin(text)
