import { useEffect } from "preact/hooks";

/** Names the view in the title of the page, by which tabs and the history are told apart. */
export function useTitle(name: string | undefined): void {
  useEffect(() => {
    document.title = name ? `${name} – Scree` : "Scree";
    return () => {
      document.title = "Scree";
    };
  }, [name]);
}
