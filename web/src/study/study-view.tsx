export function StudyView({ id }: { id: string }) { return <h1>{id}</h1>; }
