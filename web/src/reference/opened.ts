import { useEffect, useState } from "preact/hooks";

/** Anchor of the address, kept up to date; counted, so that the same link works twice. */
export function useAnchor(): { anchor: string; count: number } {
  const [seen, setSeen] = useState(() => ({ anchor: current(), count: 0 }));
  useEffect(() => {
    const look = () => setSeen(({ count }) => ({ anchor: current(), count: count + 1 }));
    // A link to the present anchor changes no address.
    const pressed = (event: MouseEvent) => {
      const link = (event.target as Element | null)?.closest("a");
      if (link?.getAttribute("href")?.startsWith("#") && link.hash === location.hash) look();
    };
    window.addEventListener("hashchange", look);
    document.addEventListener("click", pressed);
    return () => {
      window.removeEventListener("hashchange", look);
      document.removeEventListener("click", pressed);
    };
  }, []);
  return seen;
}

function current(): string {
  try {
    return decodeURIComponent(location.hash.slice(1));
  } catch {
    // An address of somebody's own, such as `#%`.
    return "";
  }
}
