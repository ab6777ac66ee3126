import gap from "../../../configs/studies/gap.json";
import sourcePaper from "../../../configs/studies/source_paper.json";
import levels from "../../../configs/studies/source_paper_levels.json";

/** Studies to begin with. */
export const PRESETS: { title: string }[] = [sourcePaper, gap, levels];
