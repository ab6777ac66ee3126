/** Copies a text; on a page without a secure address by selecting what is shown. */
export async function copyText(text: string, shown: Element | null): Promise<boolean> {
  // Only secure pages have a clipboard, whatever the types say.
  const clipboard = navigator.clipboard as Clipboard | undefined;
  if (clipboard) {
    try {
      await clipboard.writeText(text);
      return true;
    } catch {
      // The reader has not allowed it: there is the other way.
    }
  }
  if (shown) getSelection()?.selectAllChildren(shown);
  return document.execCommand("copy");
}
