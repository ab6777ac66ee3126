/** Bounds of a probability from counts, as the service has them (Clopper & Pearson 1934). */

/** Probability that a bound is missed on either side. */
const TAIL = 0.025;
/** Halvings of a bracket, far below what a picture shows. */
const HALVINGS = 40;
/** Share of a sum below which further terms are left out. */
const NEGLIGIBLE = 1e-15;

const logFactorials = [0, 0];

function logFactorial(count: number): number {
  for (let next = logFactorials.length; next <= count; next += 1) {
    logFactorials.push((logFactorials[next - 1] ?? 0) + Math.log(next));
  }
  return logFactorials[count] ?? 0;
}

/** Probability of k or more successes of n, each of probability p. */
export function atLeast(k: number, n: number, p: number): number {
  if (k <= 0 || p >= 1) return k <= n ? 1 : 0;
  if (k > n || p <= 0) return 0;
  return k > n * p ? upperSum(k, n, p) : 1 - upperSum(n - k + 1, n, 1 - p);
}

/** Sum of the probabilities of k, k + 1, …, n, which fall from k on. */
function upperSum(k: number, n: number, p: number): number {
  const ways = logFactorial(n) - logFactorial(k) - logFactorial(n - k);
  let term = Math.exp(ways + k * Math.log(p) + (n - k) * Math.log1p(-p));
  let sum = 0;
  for (let successes = k; successes <= n; successes += 1) {
    sum += term;
    if (term < NEGLIGIBLE * sum) break;
    term *= ((n - successes) / (successes + 1)) * (p / (1 - p));
  }
  return sum;
}

/** Lower bound of the probability behind k successes of n. */
export function lowerBound(k: number, n: number): number {
  if (k <= 0) return 0;
  let [low, high] = [0, 1];
  for (let halving = 0; halving < HALVINGS; halving += 1) {
    const middle = 0.5 * (low + high);
    if (atLeast(k, n, middle) < TAIL) low = middle;
    else high = middle;
  }
  return low;
}

/** Upper bound, likewise. */
export function upperBound(k: number, n: number): number {
  return 1 - lowerBound(n - k, n);
}
