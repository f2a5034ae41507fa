// A program on roslib that does what it is told: one JSON command a line on stdin, one JSON answer or event a line on stdout.
//   node peer.mjs
// It is one client after the other: `begin` connects a new one, `finish` closes its connection, and nothing of it is told then.
import { createInterface } from "node:readline";
import { Action, Param, Ros, Service, Topic } from "roslib";

const say = (line) => process.stdout.write(`${JSON.stringify(line, readable)}\n`);
const readable = (_, value) => {
  if (ArrayBuffer.isView(value)) {
    return { array: value.constructor.name, values: Array.from(value, Number) };
  }
  return typeof value === "bigint" ? Number(value) : value;
};

let ros = null;
let url = "";
const stores = [new Map(), new Map(), new Map()];
const [topics, services, actions] = stores;
const tell = (line, by = ros) => {
  if (by !== null && by === ros) say(line);
};
const kept = (store, name, make) => {
  if (!store.has(name)) store.set(name, make());
  return store.get(name);
};
const topic = ({ name, type, ...options }) =>
  kept(topics, name, () => new Topic({ ros, name, messageType: type, ...options }));
const service = ({ name, type }) => kept(services, name, () => new Service({ ros, name, serviceType: type }));
const action = ({ name, type }) => kept(actions, name, () => new Action({ ros, name, actionType: type }));
const ended = (work) =>
  new Promise((resolve) => work((values) => resolve({ values }), (reason) => resolve({ failed: reason })));

const commands = {
  subscribe: (wanted) => topic(wanted).subscribe((msg) => tell({ event: "message", name: wanted.name, msg })),
  unsubscribe: (wanted) => topic(wanted).unsubscribe(),
  advertise: (wanted) => topic(wanted).advertise(),
  unadvertise: (wanted) => topic(wanted).unadvertise(),
  publish: ({ msg, ...wanted }) => topic(wanted).publish(msg),
  call: ({ args, ...wanted }) => 
    ended((done, failed) =>
      new Service({ ros, name: wanted.name, serviceType: wanted.type }).callService(args ?? {}, done, failed),
    ),
  serve: ({ values, result, ...wanted }) =>
    service(wanted).advertise((request, response) => {
      tell({ event: "request", name: wanted.name, msg: request });
      Object.assign(response, values);
      return result ?? true;
    }),
  serve_and_throw: ({ reason, ...wanted }) =>
    service(wanted).advertiseAsync(async () => {
      throw new Error(reason);
    }),
  unserve: (wanted) => service(wanted).unadvertise(),
  goal: ({ args, ...wanted }) => {
    const event = (kind) => (msg) => tell({ event: kind, name: wanted.name, msg });
    return { id: action(wanted).sendGoal(args, event("result"), event("feedback"), event("failed")) };
  },
  cancel: ({ id, ...wanted }) => action(wanted).cancelGoal(id),
  perform: (wanted) =>
    action(wanted).advertise(
      (msg, id) => tell({ event: "goal", name: wanted.name, msg, id }),
      (id) => tell({ event: "cancel", name: wanted.name, id }),
    ),
  feedback: ({ id, values, ...wanted }) => action(wanted).sendFeedback(id, values),
  succeed: ({ id, values, ...wanted }) => action(wanted).setSucceeded(id, values),
  give_up: ({ id, values, ...wanted }) => action(wanted).setCanceled(id, values),
  fail: ({ id, ...wanted }) => action(wanted).setFailed(id),
  ask: ({ method, args }) => ended((done, failed) => ros[method](...(args ?? []), done, failed)),
  get_param: ({ name }) => ended((done, failed) => new Param({ ros, name }).get(done, failed)),
  set_param: ({ name, value }) => ended((done, failed) => new Param({ ros, name }).set(value, done, failed)),
  delete_param: ({ name }) => ended((done, failed) => new Param({ ros, name }).delete(done, failed)),
  level: ({ level }) => ros.setStatusLevel(level),
  say: ({ op }) => ros.callOnConnection(op),
  hear: ({ name }) => {
    ros.on(name, (message) => tell({ event: "heard", name, msg: message }));
  },
  connect: () => ros.connect(url).catch(() => undefined),
};

const begin = async ({ port }) => {
  url = `ws://127.0.0.1:${port}`;
  const made = new Ros();
  ros = made;
  made.on("status", (message) => tell({ event: "status", name: message.level, msg: message.msg, id: message.id }, made));
  made.on("error", (error) => tell({ event: "trouble", name: "error", msg: String(error.message ?? error) }, made));
  made.on("connection", () => tell({ event: "connection" }, made));
  made.on("close", () => tell({ event: "close" }, made));
  await made.connect(url).catch(() => undefined);
};

const finish = () =>
  new Promise((resolve) => {
    ros.on("close", () => {
      ros = null;
      for (const store of stores) store.clear();
      resolve();
    });
    ros.close();
  });

createInterface({ input: process.stdin })
  .on("line", async (line) => {
    const { number, command, ...wanted } = JSON.parse(line);
    const answer = await { begin, finish, ...commands }[command](wanted);
    say({ number, answer: answer ?? null });
  })
  .on("close", () => process.exit(0));
