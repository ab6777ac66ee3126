import { Modal } from "./modal";

/** Question whether a job shall be removed. */
export function RemoveDialog({ close, remove }: { close: () => void; remove: () => void }) {
  return (
    <Modal title="Remove this job?" close={close}>
      <p>Its scenario, outcome and all records are deleted. This cannot be undone.</p>
      <div class="actions">
        <button
          type="button"
          class="primary"
          onClick={() => {
            close();
            remove();
          }}
        >
          Remove it
        </button>
        <button type="button" onClick={close}>
          Keep it
        </button>
      </div>
    </Modal>
  );
}
