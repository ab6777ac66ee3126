"""Makes the modules of the package that follow from the contract, api/openapi.json.

``make_contract.py [FOLDER]`` writes ``contract.py`` (the documents as typed dictionaries, by
datamodel-code-generator) and ``columns.py`` (units of a trajectory's columns) into the package,
or into FOLDER.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
CONTRACT = HERE.parent / "api" / "openapi.json"
HEADER = '"""Documents of the contract, made from api/openapi.json by make_contract.py."""'
OPTIONS = [
    *("--input-file-type", "openapi", "--openapi-scopes", "schemas"),
    *("--output-model-type", "typing.TypedDict", "--enum-field-as-literal", "all"),
    *("--use-schema-description", "--use-field-description", "--disable-timestamp"),
    # The forms that the oldest Python can evaluate.
    *(
        "--target-python-version",
        "3.10",
        "--no-use-union-operator",
        "--no-use-standard-collections",
    ),
    # Closed dictionaries are unknown to mypy.
    *("--no-use-closed-typed-dict", "--formatters", "builtin"),
]
COLUMNS = '''"""Columns of a trajectory, made from api/openapi.json by make_contract.py."""

from typing import Dict, NamedTuple


class Column(NamedTuple):
    """Unit and meaning of a column; the unit is "1" where there is none."""

    unit: str
    description: str


COLUMNS: Dict[str, Column] = {{
{}}}
'''


def write_documents(target: pathlib.Path) -> None:
    """Writes the documents of the contract as typed dictionaries."""
    generator = [sys.executable, "-m", "datamodel_code_generator", *OPTIONS]
    # Its formatter looks for settings near the file: the same everywhere only away from any.
    with tempfile.TemporaryDirectory() as folder:
        made = pathlib.Path(folder) / "contract.py"
        files = ["--input", str(CONTRACT), "--output", str(made), "--custom-file-header", HEADER]
        subprocess.run([*generator, *files], check=True, cwd=folder)  # noqa: S603 -- all from here
        text = made.read_text(encoding="utf-8")
    # `typing_extensions` has all names of `typing`, the newer ones for the oldest Python too.
    target.write_text(text.replace("\nfrom typing import", "\nfrom typing_extensions import"))


def write_columns(target: pathlib.Path) -> None:
    """Writes units and meanings of the columns of a trajectory."""
    schemas = json.loads(CONTRACT.read_text(encoding="utf-8"))["components"]["schemas"]
    lines = []
    for name, schema in schemas["TrajectoryColumns"]["properties"].items():
        cell = schema["items"]
        # A vector's unit is that of its components.
        unit = cell.get("items", cell).get("x-unit", "1")
        meaning = schema["description"].rstrip(".")
        # The unit has a place of its own.
        meaning = re.sub(rf" \[{re.escape(unit)}\]$", "", meaning)
        lines.append(
            f"    {json.dumps(name)}: Column({json.dumps(unit)}, {json.dumps(meaning)}),\n"
        )
    target.write_text(COLUMNS.format("".join(lines)))


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "src" / "scree"
    write_documents(folder / "contract.py")
    write_columns(folder / "columns.py")
