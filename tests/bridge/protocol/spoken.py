"""Frames as the client libraries and the servers in use write them, and operations of every kind."""

from __future__ import annotations

from msgspec import Raw

from bridge.protocol import (
    ActionFeedback,
    ActionResult,
    Advertise,
    AdvertiseAction,
    AdvertiseService,
    Auth,
    CallService,
    CancelActionGoal,
    Fragment,
    Png,
    Publish,
    Reduction,
    SendActionGoal,
    ServiceResponse,
    SetLevel,
    Status,
    Subscribe,
    Unadvertise,
    UnadvertiseAction,
    UnadvertiseService,
    Unsubscribe,
)

EVERY_OP = [
    Advertise(topic="/cmd_vel", type="geometry_msgs/Twist", id="a", latch=True, queue_size=1),
    Unadvertise(topic="/cmd_vel", id=7),
    Publish(topic="/cmd_vel", msg=Raw(b'{"linear":{"x":1}}'), stamp=12.5),
    Subscribe(
        topic="/odom", throttle_rate=100, queue_length=1, compression="cbor", id="s", fragment_size=500
    ),
    Subscribe(topic="/scan", reduce=Reduction(fields=("ranges",), beams=90, resolution=0.1)),
    Unsubscribe(topic="/odom"),
    CallService(service="/stop", args=Raw(b"[1,2]"), id=1.5, timeout=2),
    ServiceResponse(service="/stop", values=Raw(b'"no"'), result=False, id="c"),
    AdvertiseService(service="/add", type="rospy_tutorials/AddTwoInts"),
    UnadvertiseService(service="/add"),
    AdvertiseAction(action="/dock", type="dock_msgs/action/Dock"),
    UnadvertiseAction(action="/dock"),
    SendActionGoal(
        action="/dock", action_type="dock_msgs/action/Dock", args=Raw(b'{"x":1}'), feedback=True, id="g"
    ),
    CancelActionGoal(action="/dock", id="g"),
    ActionFeedback(action="/dock", values=Raw(b'{"left":2}'), id="g"),
    ActionResult(action="/dock", values=Raw(b'{"done":true}'), status=4, id="g"),
    Fragment(data='{"op":"pub', num=0, total=2, id="f"),
    Png(data="iVBORw0KGgo="),
    Status(level="warning", msg="hm", id=3),
    SetLevel(level="info"),
    Auth(id="x"),
]

FROM_CLIENTS = {
    "roslibpy advertises": '{"op": "advertise", "id": "advertise:/cmd_vel:1", "type": "geometry_msgs/Twist", '
    '"topic": "/cmd_vel", "latch": false, "queue_size": 100}',
    "roslibpy publishes NaN": '{"op": "publish", "id": "publish:/cmd_vel:2", "topic": "/cmd_vel", '
    '"msg": {"linear": {"x": NaN, "y": -Infinity}}, "latch": false}',
    "roslibpy subscribes": '{"op": "subscribe", "id": "subscribe:/odom:3", "type": "nav_msgs/Odometry", '
    '"topic": "/odom", "compression": null, "throttle_rate": 0, "queue_length": 0}',
    "roslibpy unsubscribes": '{"op": "unsubscribe", "id": "subscribe:/odom:3", "topic": "/odom"}',
    "roslibpy calls": '{"op": "call_service", "id": "call_service:/rosapi/topics:4", "service": "/rosapi/topics", '
    '"args": {}}',
    "roslibpy offers a service": '{"op": "advertise_service", "type": "std_srvs/SetBool", "service": "/lamp"}',
    "roslibpy answers": '{"op": "service_response", "service": "/lamp", "values": {"success": true}, '
    '"result": true, "id": "service_request:/lamp:1"}',
    "roslibpy answers with None": '{"op": "service_response", "service": "/lamp", "values": {}, "result": null, '
    '"id": "service_request:/lamp:2"}',
    "roslibpy sends a goal": '{"op": "send_action_goal", "id": "send_action_goal:/fibonacci:5", '
    '"action": "/fibonacci", "action_type": "example_interfaces/action/Fibonacci", "args": {"order": 8}, '
    '"feedback": true}',
    "roslibpy cancels it": '{"op": "cancel_action_goal", "id": "send_action_goal:/fibonacci:5", '
    '"action": "/fibonacci"}',
    "roslibpy sets the level": '{"op": "set_level", "level": "info", "id": null}',
    "roslibpy shows who it is": '{"op": "auth", "mac": "00", "client": "c", "dest": "d", "rand": "r", "t": 1, '
    '"level": "user", "end": 0}',
    "roslib subscribes": '{"op":"subscribe","id":"subscribe:/scan:0b1e","type":"sensor_msgs/LaserScan",'
    '"topic":"/scan","compression":"cbor","throttle_rate":100,"queue_length":1}',
    "roslib subscribes in fragments": '{"op":"subscribe","id":"s","topic":"/map","type":"nav_msgs/OccupancyGrid",'
    '"compression":"png","throttle_rate":0,"queue_length":0,"fragment_size":1000.0}',
    "roslib calls without a slash": '{"op":"call_service","id":"c:1","service":"rosapi/topics","type":"rosapi/Topics",'
    '"args":{},"timeout":5}',
    "roslib refuses": '{"op":"service_response","service":"/lamp","result":false,"id":"service_request:/lamp:3"}',
    "roslib offers an action": '{"op":"advertise_action","type":"test_msgs/action/Fibonacci","action":"/fib"}',
    "roslib tells how far": '{"op":"action_feedback","id":"action_goal:/fib:1","action":"/fib","values":{"seq":[0,1]}}',
    "roslib is done": '{"op":"action_result","id":"action_goal:/fib:1","action":"/fib","values":{"seq":[0,1]},'
    '"status":4,"result":true}',
    "roslib takes it back": '{"op":"unadvertise_action","action":"/fib"}',
    "a page of old calls": '{"op":"call_service","service":"/rosapi/topics#33","args":[]}',
    "a page counts its ids": '{"op":"call_service","id":17,"service":"/add","args":[1,2.5,"x",null]}',
    "two at once": '{"op":"unsubscribe","topic":"/a"}\n {"op":"unadvertise","topic":"/b","id":null}',
    "a slice": '{"op":"fragment","id":12,"data":"{\\"op\\":\\"unsub","num":0,"total":3.7}',
}

FROM_SERVERS = {
    "the ROS 1 server publishes": r'{"topic": "\/odom", "msg": {"header": {"seq": 1, "stamp": {"secs": 5, "nsecs": 6}, '
    r'"frame_id": "odom"}, "pose": {"covariance": [0.1, null]}}, "op": "publish"}',
    "the ROS 1 server answers": r'{"values": {"topics": ["\/a"], "types": ["std_msgs\/String"]}, "result": true, '
    r'"service": "\/rosapi\/topics", "op": "service_response", "id": "call:1"}',
    "the ROS 1 server fails": r'{"values": "Service \/nope does not exist", "result": false, "service": "\/nope", '
    r'"op": "service_response", "id": "call:2"}',
    "the ROS 1 server cuts": r'{"op": "fragment", "data": "{\"op\": \"publish\", \"to", "num": 0, "total": 3.7, "id": 0}',
    "a server has a goal": '{"op":"send_action_goal","id":"action_goal:/fib:1","action":"/fib",'
    '"action_type":"test_msgs/Fibonacci","args":{"order":3},"feedback":true}',
    "a server finishes": '{"op":"action_result","action":"/fib","values":{"status":4,"seq":[0]},"result":true,"id":"g"}',
    "a server fails at a goal": '{"op":"action_result","action":"/fib","values":"no such action","status":0,'
    '"result":false,"id":"g"}',
    "a server remarks": '{"op":"status","level":"error","msg":"Unable to load","id":"x"}',
    "the ROS 2 server calls": '{"op":"call_service","id":"service_request:/lamp:1","service":"/lamp","args":{"data":true}}',
}
