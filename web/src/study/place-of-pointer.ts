/** Place of a JSON pointer in the text of a document, so that a violation can be shown there. */

/** Range of characters of the value at a pointer, or of the nearest value around it. */
export function placeOfPointer(text: string, pointer: string): [from: number, to: number] | undefined {
  const keys = pointer
    .split("/")
    .slice(1)
    .map((key) => key.replaceAll("~1", "/").replaceAll("~0", "~"));
  try {
    return new Scanner(text).find(keys);
  } catch {
    return undefined;
  }
}

/** Scanner of a text that is JSON. */
class Scanner {
  private at = 0;

  constructor(private readonly text: string) {}

  /** Range of the value that begins here, or of the one in it that the keys lead to. */
  find(keys: string[]): [number, number] {
    this.space();
    const from = this.at;
    const [key, ...rest] = keys;
    const opened = this.text[this.at];
    let found: [number, number] | undefined;
    if (opened === "{" || opened === "[") {
      this.at += 1;
      for (let place = 0; this.next(opened); place += 1) {
        const name = opened === "{" ? this.name() : String(place);
        const range = this.find(name === key ? rest : []);
        if (name === key) found = range;
      }
    } else if (opened === '"') this.string();
    else this.at += /^[^\s,\]}]*/.exec(this.text.slice(this.at))?.[0].length ?? 0;
    return found ?? [from, this.at];
  }

  /** True if another entry follows, false after the closing bracket. */
  private next(opened: string): boolean {
    this.space();
    if (this.text[this.at] === ",") this.at += 1;
    this.space();
    if (this.at >= this.text.length) throw new Error("the text ends within a value");
    if (this.text[this.at] !== (opened === "{" ? "}" : "]")) return true;
    this.at += 1;
    return false;
  }

  private name(): string {
    const name = this.string();
    this.space();
    this.at += 1;
    return name;
  }

  private string(): string {
    const found = /^"(?:[^"\\]|\\.)*"/.exec(this.text.slice(this.at))?.[0];
    if (found === undefined) throw new Error("no string where one is expected");
    this.at += found.length;
    return JSON.parse(found) as string;
  }

  private space(): void {
    while (/\s/.test(this.text[this.at] ?? "")) this.at += 1;
  }
}
