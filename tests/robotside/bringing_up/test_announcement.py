"""What the terminal shows of a robot: few lines, each of which a program or a person can use."""

from __future__ import annotations

from bridge.msgs.pilothouse_msgs import Event
from bridge.msgs.std_msgs import String
from bridge.trust.robot_link import read_link
from robotside.bringing_up.announcement import news, qr_code, ready


def test_each_gateway_has_one_line_and_the_rest_is_on_the_page() -> None:
    gateways = {"mqtt": "mqtt://192.0.2.1:1883/pilothouse/Rex"}
    lines = ready("Rex", "ws://127.0.0.1:9090", "http://127.0.0.1:8080", gateways, host="127.0.0.1")
    assert lines == [
        "robotside: ready bridge=ws://127.0.0.1:9090 http=http://127.0.0.1:8080 robot=Rex",
        "robotside: gateway mqtt=mqtt://192.0.2.1:1883/pilothouse/Rex",
        "robotside: usage http://127.0.0.1:8080/ or python -m robotside guide",
    ]


def test_the_guide_is_named_where_it_can_be_asked_for() -> None:
    everywhere = ready("Rex", "", "https://192.0.2.7:8081", {}, host="0.0.0.0")[-1]
    assert everywhere.endswith("or python -m robotside guide --at http://127.0.0.1:8081")
    assert "guide" not in ready("Rex", "", "https://192.0.2.7:8080", {}, host="192.0.2.7")[-1]


def test_a_code_is_shown_where_others_reach_the_robot() -> None:
    shown = qr_code("Rex", "wss://192.0.2.7:9090").splitlines()
    assert len(shown) > 12
    assert read_link(shown[-1]).name == "Rex"
    assert qr_code("Rex", "ws://127.0.0.1:9090") == ""


def test_what_happens_to_a_gateway_is_told_and_nothing_else() -> None:
    lost = Event(text="The MQTT broker is not reached: connection refused.", code="gateway_lost")
    assert news("Rex", lost) == "robotside: Rex: The MQTT broker is not reached: connection refused."
    assert (
        news("Rex", Event(text="Camera is off.", code="payload_switched")) == "robotside: Rex: Camera is off."
    )
    assert news("Rex", Event(text="The task is done.", code="task_done")) == ""
    assert news("Rex", String("gateway_lost")) == ""
