import { useEffect, useState } from "preact/hooks";

/** Colours that canvases take from the style sheet. */
export interface Theme {
  isDark: boolean;
  paper: string;
  raised: string;
  ink: string;
  quiet: string;
  line: string;
  accent: string;
  ground: string;
}

const DARK = "(prefers-color-scheme: dark)";

/** The present theme. */
export function themeNow(): Theme {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string) => style.getPropertyValue(`--${name}`).trim();
  return {
    isDark: matchMedia(DARK).matches,
    paper: colour("paper"),
    raised: colour("raised"),
    ink: colour("ink"),
    quiet: colour("quiet"),
    line: colour("line"),
    accent: colour("accent"),
    ground: colour("ground"),
  };
}

/** The theme, kept up to date. */
export function useTheme(): Theme {
  const [theme, setTheme] = useState(themeNow);
  useEffect(() => {
    const query = matchMedia(DARK);
    const change = () => setTheme(themeNow());
    query.addEventListener("change", change);
    return () => query.removeEventListener("change", change);
  }, []);
  return theme;
}
