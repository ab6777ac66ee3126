export function JobView({ id }: { id: string }) {
  return <h1>{id}</h1>;
}
