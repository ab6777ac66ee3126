import { render } from "preact";
import "../style.css";
import { ReferencePage } from "./reference-page";
import "./reference.css";

const root = document.getElementById("reference");
if (root) render(<ReferencePage />, root);
