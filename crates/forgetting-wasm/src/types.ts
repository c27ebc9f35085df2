/** Numbers in: a number, a typed array, or an array of numbers or of rows. */
export type Numbers = number | Float64Array | Float32Array | number[] | number[][];

/** An entry of a registry by name, alone or with values for its parameters. */
export type Choice = string | { name: string; [parameter: string]: unknown };

/** A rule, its forgetting factor (a number, a rate, or null for none) among its parameters. */
export type Rule =
  | string
  | { name: string; forgetting_factor?: number | Choice | null; [parameter: string]: unknown };

/** What estimators and banks share. */
export interface CommonSettings {
  /** How far to trust a sample; all equally, if not given. */
  weighting?: Choice;
  /** Whether a sample is used; always, if not given. */
  gate?: Choice;
  /** P before the first sample: a number, (n,) or (n, n), in units of 1/φ². If not given it follows the data. */
  initial_covariance?: Numbers;
  /** θ before the first sample, (n,) or (n, targets); 0 if not given. */
  initial_theta?: Numbers;
  /** Measurements of a sample that share one θ; 1 if not given. */
  rows?: number;
  /** Parameter vectors that share φ and P; 1 if not given. */
  targets?: number;
  /** The type of the numbers that are computed with; "float64" if not given. */
  dtype?: "float64" | "float32";
}

/** What an estimator is made from. */
export interface Settings extends CommonSettings {
  /** Where to forget. If not given, a random walk that is bounded, or `subspace` where P or a factor is given. */
  rule?: Rule;
  /** How much to forget, where the rule does not say it: a number in (0, 1] or a rate. */
  forgetting_factor?: number | Choice | null;
  /** Whether windup, excitation and noise are watched; see `RLS.health`. */
  monitor?: boolean;
}

/** What a bank is made from. */
export interface BankSettings extends CommonSettings {
  /** The rules of the members, 1 to 1024; rules of all speeds, if not given. */
  members?: Rule[];
  /** What weighs the members; "mlpol" if not given. */
  mixer?: Choice;
}

/** How a sample is taken. */
export interface UpdateOptions {
  /** Noise covariance of the sample: a number or (rows, rows); 1 if not given. */
  gamma?: Numbers;
  /** What is done with a sample that has a NaN; "error" if not given. */
  missing?: "error" | "skip";
  /** Time since the last sample, in the unit in which forgetting is stated; 1 if not given. */
  elapsed?: number;
}

/** How a record is taken. */
export interface RunOptions {
  /** Noise covariance: a number, (T,), (rows, rows) or (T, rows, rows) one after the other. */
  gamma?: Numbers;
  /** What is done with samples that have a NaN; "error" if not given. */
  missing?: "error" | "skip";
  /** When samples were taken, (T,), not decreasing; one unit each, if not given. */
  time?: Numbers;
  /** Names of the results that are kept. */
  outputs?: Output | Output[];
}

export type Output =
  | "theta" | "error" | "leverage" | "forgetting_factor" | "rank" | "skipped" | "gate" | "windup"
  | "whitened_innovation" | "variance" | "covariance" | "prior_covariance" | "weight"
  | "weights" | "memory";

/** What a bank did with a sample. */
export interface BankUpdate {
  /** y − φθ with the θ of before. */
  error: number | Float64Array;
  /** The variance of the prediction in units of the noise variance. */
  leverage: number;
  /** The forgetting factor used, in (0, 1]. */
  forgetting_factor: number;
  /** Why the sample was left out; null if it was used. */
  skipped: string | null;
  /** Whether P has wound up. */
  windup: boolean;
  /** Members of a bank that could not take the sample. */
  asleep: number;
}

/** What an estimator did with a sample. */
export interface Update extends Omit<BankUpdate, "asleep"> {
  /** L⁻¹(y − φθ) with L Lᵀ = Γ + φPφᵀ. */
  whitened_innovation: number | Float64Array;
  /** Γ was divided by this. */
  weight: number;
  /** Number of directions that lost information. */
  rank: number;
  /** What the gate said. */
  gate: "update" | "freeze" | "hold";
}

/** Results of a record of T samples: those that were asked for, one row after the other. */
export interface Run {
  /** Samples in the record, and how many of them were used. */
  samples: number;
  used: number;
  /** θ after each sample, (T, n) or (T, n, targets). */
  theta?: Float64Array;
  /** y − φθ with the θ of before, as y; NaN where a value is missing. */
  error?: Float64Array;
  leverage?: Float64Array;
  forgetting_factor?: Float64Array;
  rank?: Int32Array;
  /** Codes, see `skip_codes` and `gate_codes`. */
  skipped?: Uint8Array;
  gate?: Uint8Array;
  /** 1 where P has wound up. */
  windup?: Uint8Array;
  whitened_innovation?: Float64Array;
  /** Diagonal of P after each sample, (T, n). */
  variance?: Float64Array;
  /** P after each sample, (T, n, n), and before its data. */
  covariance?: Float64Array;
  prior_covariance?: Float64Array;
  weight?: Float64Array;
  /** Of a bank: how far each member was believed, (T, members), and its memory in samples. */
  weights?: Float64Array;
  memory?: Float64Array;
}

/** What the monitor over an estimator has found. */
export interface Health {
  /** "windup": P grew without information. "unexcited": some direction is not informed now. "recovering": it is
   *  again, but is known far worse than before. "saturated": P is at the edge of its number type. */
  status: "ok" | "unexcited" | "recovering" | "windup" | "saturated";
  /** The largest and the smallest element of D: bounds of the eigenvalues of P from within. */
  largest_eigenvalue: number;
  smallest_eigenvalue: number;
  windup: boolean;
  /** Whether the weakest direction is informed now; the direction (n,), a unit vector. */
  informed: boolean;
  direction: Float64Array;
  /** The smallest variance that each parameter has had, (n,). */
  least_variances: Float64Array;
  /** The variance in P along the direction, and over what it was when last informed. */
  variance: number;
  growth: number;
  since_informed: number;
  /** Samples since each parameter was excited, (n,). */
  since_excited: Int32Array;
  /** Of the whitened noise; NaN before the first sample. */
  noise_variance: number;
  /** Lag-one correlation of the normalized innovations, in [−1, 1]. */
  correlation: number;
  /** Samples watched, and how many the two estimates before stand on. */
  samples: number;
  weight: number;
}

/** What an estimator is made of. */
export interface Description {
  rule: Choice;
  rate: Choice;
  weighting: Choice;
  gate: Choice;
}

/** A parameter of an entry. */
export interface Parameter {
  name: string;
  /** What it means, with its unit. */
  about: string;
  kind: "real" | "whole" | "word" | "matrix" | "list" | "rule" | "function";
  /** The values allowed, in words. */
  range: string;
  /** The words allowed, of a word. */
  words: string[];
  required: boolean;
  default: unknown;
}

/** An entry of a registry. */
export interface Entry {
  name: string;
  /** What it does, in a sentence. */
  summary: string;
  parameters: Parameter[];
  /** Of a rule: whether it takes a forgetting factor, and its cost. */
  forgetting_factor?: boolean;
  cost?: string;
  largest_rows?: number;
  /** Of a rule: whether it guarantees that P̄ is proper and bounded. */
  proper?: string;
  bounded_above?: string;
  bounded_below?: string;
}

/** The choices that answer one question. */
export interface Axis {
  name: string;
  plural: string;
  summary: string;
  entries: Entry[];
}
