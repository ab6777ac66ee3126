import { request } from "../api/client";

/** Has the browser save contents as a file. */
export function saveFile(contents: Blob, name: string): void {
  const address = URL.createObjectURL(contents);
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  // The browser reads the address after the click.
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

/** Saves an answer of the service as a file; a plain link would not show the token. */
export async function saveAnswer(path: string, name: string): Promise<void> {
  const response = await request(path);
  saveFile(await response.blob(), name);
}
