export function FormView() { return <h1>FormView</h1>; }
