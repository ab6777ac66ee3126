/** Address of the view within the page's: a path and a query behind the `#`. */

import { useSyncExternalStore } from "preact/compat";

function subscribe(listener: () => void): () => void {
  addEventListener("hashchange", listener);
  return () => removeEventListener("hashchange", listener);
}

/** Path and query behind the `#`, as `["/new", "preset=minimal"]`. */
function parts(): [string, string] {
  const [path = "", ...query] = location.hash.replace(/^#?\/?/, "").split("?");
  return [`/${path}`, query.join("?")];
}

function navigate(to: string, { replace = false }: { replace?: boolean } = {}): void {
  const before = location.href;
  history[replace ? "replaceState" : "pushState"](null, "", `#/${to.replace(/^#?\/?/, "")}`);
  dispatchEvent(new HashChangeEvent("hashchange", { oldURL: before, newURL: location.href }));
}

const usePath = (): [string, typeof navigate] => [useSyncExternalStore(subscribe, () => parts()[0]), navigate];

/** Location hook of the router: the path alone, so that a query changes no route. */
export const useHashLocation = Object.assign(usePath, { hrefs: (href: string) => `#${href}` });

/** Search hook of the router: the query behind the path. */
export const useHashSearch = (): string => useSyncExternalStore(subscribe, () => parts()[1]);
