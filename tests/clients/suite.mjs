// What roslib's own suite does with a ROS system: one line of JSON says how each scenario went.
//   node suite.mjs ws://HOST:PORT
import assert from "node:assert/strict";
import { Action, ActionClient, Goal, Param, Ros, ROS2TFClient, Service, SimpleActionServer, TFClient, Topic } from "roslib";

const url = process.argv[2];
const TIMEOUT = 60000;
const SEQUENCE = [0, 1, 1, 2, 3, 5, 8, 13, 21];

const within = (about, work) =>
  new Promise((resolve, reject) => {
    const timer = setTimeout(() => reject(new Error(`no ${about} in time`)), TIMEOUT);
    work(
      (value) => (clearTimeout(timer), resolve(value)),
      (reason) => (clearTimeout(timer), reject(new Error(String(reason)))),
    );
  });
const connected = async (options = {}) => {
  const ros = new Ros(options);
  await ros.connect(url);
  return ros;
};
const until = async (about, holds) => {
  for (const end = Date.now() + TIMEOUT; Date.now() < end; ) {
    if (await holds()) return;
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
  throw new Error(`${about} did not come`);
};
const topicsOf = async (ros) => (await within("topics", (done, failed) => ros.getTopics(done, failed))).topics;

const scenarios = {
  async topics_come_and_go(ros) {
    assert.ok((await topicsOf(ros)).includes("/listener"));
    const topic = new Topic({ ros, name: "/some_test_topic", messageType: "std_msgs/String" });
    assert.ok(!(await topicsOf(ros)).includes("/some_test_topic"));
    topic.advertise();
    await until("the topic", async () => (await topicsOf(ros)).includes("/some_test_topic"));
    topic.unadvertise();
    await until("its end", async () => !(await topicsOf(ros)).includes("/some_test_topic"));
  },
  async two_topics_of_a_name_talk_and_end_apart(ros) {
    const [one, two] = [0, 1].map(() => new Topic({ ros, name: "/example_topic", messageType: "std_msgs/String" }));
    const heard = { one: [], two: [] };
    one.subscribe((msg) => heard.one.push(msg.data));
    two.subscribe((msg) => heard.two.push(msg.data));
    for (const data of ["Hello", "there"]) one.publish({ data });
    await until("the words", async () => heard.one.length === 2 && heard.two.length === 2);
    one.unsubscribe();
    two.publish({ data: "hi" });
    await until("the last word", async () => heard.two.length === 3);
    assert.deepEqual(heard, { one: ["Hello", "there"], two: ["Hello", "there", "hi"] });
    two.unsubscribe();
    for (const topic of [one, two]) topic.unadvertise();
  },
  async a_topic_comes_as_png(ros) {
    const topic = new Topic({ ros, name: "/png_test", messageType: "std_msgs/String", compression: "png" });
    const said = { data: "some text that becomes a picture" };
    const heard = within("picture", (done) => topic.subscribe(done));
    topic.publish(said);
    assert.deepEqual(await heard, said);
    topic.unsubscribe();
  },
  async the_listener_says_hello(ros) {
    const topic = new Topic({ ros, name: "/listener", messageType: "std_msgs/msg/String" });
    assert.deepEqual(await within("hello", (done) => topic.subscribe(done)), { data: "Hello, World" });
    topic.unsubscribe();
  },
  async the_service_adds_two_ints(ros) {
    for (const serviceType of ["rospy_tutorials/AddTwoInts", "example_interfaces/srv/AddTwoInts"]) {
      const service = new Service({ ros, name: "/add_two_ints", serviceType });
      const answer = await within("sum", (done, failed) => service.callService({ a: 2, b: 40 }, done, failed));
      assert.equal(Number(answer.sum), 42);
    }
  },
  async a_service_of_its_own_is_called_and_advertised_again(ros) {
    const name = "/test_service";
    const server = new Service({ ros, name, serviceType: "std_srvs/Trigger" });
    const client = new Service({ ros, name, serviceType: "std_srvs/Trigger" });
    for (const message of ["foo", "bar"]) {
      await server.advertiseAsync(async () => ({ success: true, message }));
      const answer = await within("answer", (done, failed) => client.callService({}, done, failed));
      assert.deepEqual(answer, { success: true, message });
      await server.unadvertise();
    }
    await Promise.all([server.advertise(() => true), server.unadvertise(), server.advertise(() => true)]);
    assert.ok(server.isAdvertised);
    await server.unadvertise();
  },
  async a_parameter_comes_and_goes(ros) {
    for (const name of ["/test/foo", "/add_two_ints_server:use_sim_time"]) {
      const param = new Param({ ros, name });
      for (const value of [true, false]) {
        await within("set", (done, failed) => param.set(value, done, failed));
        assert.equal(await within("get", (done, failed) => param.get(done, failed)), value);
      }
      assert.ok((await within("names", (done, failed) => ros.getParams(done, failed))).includes(name));
      await within("delete", (done, failed) => param.delete(done, failed));
      assert.ok(!(await within("names", (done, failed) => ros.getParams(done, failed))).includes(name));
    }
  },
  async an_action_of_ros_1_gives_fibonacci_s_numbers(ros) {
    const actionClient = new ActionClient({ ros, serverName: "/fibonacci", actionName: "actionlib_tutorials/FibonacciAction" });
    const goal = new Goal({ actionClient, goalMessage: { order: 7 } });
    const steps = [];
    goal.on("feedback", (feedback) => steps.push(feedback.sequence));
    const result = within("result", (done) => goal.on("result", done));
    await topicsOf(ros); // the server has heard the subscriptions
    goal.send();
    assert.deepEqual(Array.from((await result).sequence), SEQUENCE);
    assert.deepEqual(steps.map((step) => Array.from(step)), [1, 2, 3, 4, 5, 6, 7].map((n) => SEQUENCE.slice(0, n + 2)));
    actionClient.dispose();
  },
  async an_action_server_of_its_own_is_cancelled_and_lives_on(ros) {
    const options = { ros, serverName: "/test_action_js", actionName: "actionlib/TestAction" };
    const server = new SimpleActionServer(options);
    const cancelled = within("cancel", (done) => server.on("cancel", () => (server.setPreempted(), done())));
    const client = new ActionClient(options);
    const first = new Goal({ actionClient: client, goalMessage: { goal: 1 } });
    const taken = within("goal", (done) => server.once("goal", done));
    await topicsOf(ros);
    first.send();
    await taken;
    first.cancel();
    await cancelled;
    const second = new Goal({ actionClient: client, goalMessage: { goal: 13 } });
    server.once("goal", (goal) => server.setSucceeded({ result: goal.goal }));
    const result = within("result", (done) => second.on("result", done));
    second.send();
    assert.equal((await result).result, 13);
    client.dispose();
  },
  async an_action_of_ros_2_gives_fibonacci_s_numbers(ros) {
    const action = new Action({ ros, name: "/fibonacci", actionType: "example_interfaces/action/Fibonacci" });
    const steps = [];
    const result = await within("result", (done, failed) =>
      action.sendGoal({ order: 7 }, done, (feedback) => steps.push(feedback.sequence), failed),
    );
    assert.deepEqual(Array.from(result.sequence), SEQUENCE);
    assert.equal(steps.length, 7);
  },
  async transforms_come_from_the_republisher() {
    for (const groovyCompatibility of [true, false]) {
      const ros = await connected({ groovyCompatibility });
      const client = new TFClient({ ros, fixedFrame: "world", angularThres: 0.01, transThres: 0.01 });
      const found = await within("transform", (done) => client.subscribe("turtle1", done));
      assert.deepEqual({ ...found.rotation }, { x: 0, y: 0, z: 0, w: 1 });
      assert.deepEqual({ ...found.translation }, { x: 0, y: 0, z: 0 });
      ros.close();
    }
  },
  async transforms_come_by_an_action_of_ros_2() {
    const ros = await connected();
    const client = new ROS2TFClient({ ros, fixedFrame: "world", angularThres: 0.01, transThres: 0.01 });
    const found = await within("transform", (done) => client.subscribe("turtle1", done));
    assert.deepEqual({ ...found.rotation }, { x: 0, y: 0, z: 0, w: 1 });
    ros.close();
  },
};

const ros = await connected();
const went = {};
for (const [name, scenario] of Object.entries(scenarios)) {
  went[name] = await scenario(ros).then(() => "", (error) => String(error.stack));
}
process.stdout.write(`${JSON.stringify(went)}\n`, () => process.exit(0));
