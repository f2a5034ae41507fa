"""The server goes and comes back."""

from __future__ import annotations

import asyncio

from bridge.msgs.nav_msgs import Odometry
from tests.bridge.wires import server
from tests.clients.peers import BOTH, peer

PATIENCE = 60.0
"""roslibpy lets a second pass before it subscribes again, and its own waits come on top [s]."""
ODOMETRY = {"name": "/odom", "type": "nav_msgs/Odometry"}
DOOR = {"name": "/door/open", "type": "std_srvs/SetBool"}


async def again(client, library):
    """Wait until a client is connected for the second time; roslib has to be told."""
    await client.event("close")
    if library == "roslib":
        await client.do("connect")
    await client.event("connection", count=2, patience=PATIENCE)


@BOTH
async def test_subscriptions_and_services_come_back_with_the_server(library):
    async with server() as first:
        port = first.port
        async with peer(library, port, leaves=True) as client:
            await client.do("subscribe", **ODOMETRY)
            await client.do("serve", **DOOR, values={"success": True, "message": "still here"})
            await client.settled()
            await first.close()
            async with server(port=port) as second, peer("roslib", port) as other:
                await again(client, library)
                if library == "roslib":
                    # it forgets what it offered; a program does it again
                    await client.do("unserve", **DOOR)
                    await client.do("serve", **DOOR, values={"success": True, "message": "still here"})
                async with asyncio.timeout(PATIENCE):
                    while "failed" in (answer := await other.do("call", **DOOR, args={"data": True})):
                        await client.settled()
                assert answer["values"]["message"] == "still here"
                await client.settled()
                second.publish("/odom", Odometry(child_frame_id="again"))
                assert (await client.message("/odom"))["child_frame_id"] == "again"
