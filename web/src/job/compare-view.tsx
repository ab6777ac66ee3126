export function CompareView({ ids }: { ids: [string, string] }) {
  return <h1>{ids}</h1>;
}
