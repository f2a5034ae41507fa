// A program on node's soap: reads the WSDL, asks, is refused, subscribes and is called back by its own service, and stops the robot.
//   node soap_client.cjs http://HOST:PORT/soap
// It prints one JSON object with all that it was told.
const http = require("node:http");
const soap = require("soap");

const told = {};
const refused = async (work) => {
  try {
    await work;
  } catch (error) {
    return error.root.Envelope.Body.Fault;
  }
  return null;
};

const main = async (url) => {
  const robot = await soap.createClientAsync(`${url}?wsdl`);
  const contract = await (await fetch(`${url}?subscriber.wsdl`)).text();
  const call = (more) => {
    robot.clearSoapHeaders();
    robot.addSoapHeader({ Caller: { clientId: "node", clientName: "Nora", ...more } }, "", "tns", "urn:pilothouse:robot:1");
  };
  const ask = async (name, fields = {}) => (await robot[`${name}Async`](fields))[0];

  told.info = await ask("GetInfo");
  told.places = await ask("ListPlaces");
  call({ commandId: "c1" });
  told.delivery = await ask("Deliver", { source: "Office 12", target: "Lab", item: "a < b & c" });
  told.again = await ask("Deliver", { source: "Office 12", target: "Lab", item: "a < b & c" });
  call({});
  told.unknown = await refused(robot.GoToAsync({ place: "Moon", instead: true }));
  told.bad = await refused(robot.StartTaskAsync({ task: "hold", speed: "fast" }));

  const server = http.createServer((_, response) => response.writeHead(404).end());
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const notified = new Promise((resolve) => {
    const service = { Subscriber: { SubscriberPort: { Notify: (args) => (resolve(args), {}) } } };
    soap.listen(server, "/soap", service, contract);
  });
  const callback = `http://127.0.0.1:${server.address().port}/soap`;
  told.subscription = await ask("Subscribe", { topic: ["/control/status"], callback });
  told.notified = await notified;
  server.close();
  server.closeAllConnections();

  told.stop = await ask("Stop");
  told.status = await ask("GetStatus");
  console.log(JSON.stringify(told));
};

main(process.argv[2]).catch((error) => {
  console.error(error);
  process.exit(1);
});
