"use strict";
// Everything is put in as text: nothing of the contract is taken for HTML.
const make = (name, text, ...children) => {
  const element = document.createElement(name);
  if (text) element.textContent = text;
  element.append(...children);
  return element;
};
const table = (rows) => make("table", "", ...rows.map((row) =>
  make("tr", "", ...row.map((text) => make("td", text)))));
const kind = (schema) => !schema ? "" : schema.$ref ? schema.$ref.split("/").pop()
  : schema.oneOf ? schema.oneOf.map(kind).join(" or ")
  : schema.type === "array" ? "list of " + (kind(schema.items) || "values")
  : [].concat(schema.type || "any").join(" or ");
const request = (path, method, what) => {
  const details = make("details", "",
    make("summary", "", make("code", method.toUpperCase() + " " + path), " – " + (what.summary || "")));
  if (what.description) details.append(make("p", what.description));
  if (what.parameters) details.append(table(what.parameters.map((parameter) =>
    [parameter.name, parameter.in, parameter.description || ""])));
  if (what.requestBody) details.append(make("p", "Body: " +
    Object.values(what.requestBody.content).map((content) => kind(content.schema)).join(", ")));
  details.append(table(Object.entries(what.responses).map(([status, answer]) =>
    [status, answer.description, Object.values(answer.content || {}).map((content) => kind(content.schema)).join(", ")])));
  return details;
};
fetch("openapi.json").then((answer) => answer.json()).then((contract) => {
  document.getElementById("about").textContent =
    contract.info.description + " Version " + contract.info.version + ".";
  for (const [path, methods] of Object.entries(contract.paths))
    for (const [method, what] of Object.entries(methods))
      document.getElementById("requests").append(request(path, method, what));
  for (const [name, schema] of Object.entries(contract.components.schemas)) {
    const details = make("details", "", make("summary", name), make("p", schema.description || ""));
    details.append(schema.properties
      ? table(Object.entries(schema.properties).map(([key, value]) => [key, kind(value), value.description || ""]))
      : make("pre", JSON.stringify(schema, null, 2)));
    document.getElementById("documents").append(details);
  }
});
