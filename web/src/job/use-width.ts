import { type MutableRef, useEffect, useRef, useState } from "preact/hooks";

/** An element, and its width [px], kept up to date. */
export function useWidth<T extends HTMLElement>(): [MutableRef<T | null>, number] {
  const element = useRef<T>(null);
  const [width, setWidth] = useState(0);
  useEffect(() => {
    if (!element.current) return;
    const observer = new ResizeObserver(([entry]) => setWidth(Math.floor(entry?.contentRect.width ?? 0)));
    observer.observe(element.current);
    return () => observer.disconnect();
  }, []);
  return [element, width];
}
