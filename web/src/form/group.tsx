import type { ComponentChildren } from "preact";
import { useForm, violationsWithin } from "./form-context";

interface GroupProps {
  /** Name of the group, by which it is opened. */
  name: string;
  title: ComponentChildren;
  /** Pointers of the fields in it, whose violations are counted while it is folded. */
  pointers: string[];
  isOpenAtFirst?: boolean;
  class?: string;
  children: () => ComponentChildren;
}

/** Fields that can be folded. What is folded takes no time to draw. */
export function Group({ name, title, pointers, isOpenAtFirst = false, class: kind = "group", children }: GroupProps) {
  const { isOpen, setOpen, violations } = useForm();
  const opened = isOpen(name) ?? isOpenAtFirst;
  const wrong = pointers.reduce((sum, pointer) => sum + violationsWithin(violations, pointer).length, 0);
  return (
    <details
      class={kind}
      open={opened}
      onToggle={({ currentTarget }) => {
        if (currentTarget.open !== opened) setOpen(name, currentTarget.open);
      }}
    >
      <summary>
        {title}
        {wrong > 0 && !opened && <span class="count">{wrong === 1 ? "1 violation" : `${wrong} violations`}</span>}
      </summary>
      {opened && <div class="folded">{children()}</div>}
    </details>
  );
}
