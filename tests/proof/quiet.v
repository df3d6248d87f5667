(* SPDX-License-Identifier: BSD-3-Clause *)
(** Quiet: the kernels of Theorem 2 and the circle condition of Theorem 3, docs/design/mathematics.md § 9. Schur's
    product of two positive matrices, and the lemma of Kalman and Yakubovich, are left to the page. *)

From Coq Require Import Reals Lra List.
Import ListNotations.
Open Scope R_scope.

(** A contact: its compliance c and a weight x. *)
Definition contact := (R * R)%type.
Definition total (l : list contact) : R := fold_right (fun a s => snd a + s) 0 l.

(** Σᵢ xᵢ (min(c, cᵢ) − m), and Σᵢⱼ xᵢ xⱼ (min(cᵢ, cⱼ) − m). *)
Definition row (m c : R) (l : list contact) : R :=
  fold_right (fun a s => snd a * (Rmin c (fst a) - m) + s) 0 l.
Definition kernel (m : R) (l all : list contact) : R :=
  fold_right (fun a s => snd a * row m (fst a) all + s) 0 l.

(** No contact of the list has less compliance than c. *)
Definition least (c : R) (l : list contact) : Prop := Forall (fun a => c <= fst a) l.
Inductive ascending : list contact -> Prop :=
  | none : ascending []
  | one_more c x l : least c l -> ascending l -> ascending ((c, x) :: l).

Lemma row_of_least m c l : least c l -> row m c l = (c - m) * total l.
Proof.
  induction 1 as [| [d y] l Hd _ IH]; simpl in *; [lra |].
  rewrite IH, Rmin_left by assumption. ring.
Qed.

Lemma row_shifts m c k l : row m k l = row c k l + (c - m) * total l.
Proof. induction l as [| [d y] l IH]; simpl; [ring | rewrite IH; ring]. Qed.

Lemma kernel_shifts m c l all : kernel m l all = kernel c l all + (c - m) * total l * total all.
Proof.
  induction l as [| [d y] l IH]; simpl; [ring |].
  rewrite IH, (row_shifts m c). ring.
Qed.

Lemma kernel_of_one_more m c x l all :
  least c l -> kernel m l ((c, x) :: all) = x * (c - m) * total l + kernel m l all.
Proof.
  induction 1 as [| [d y] l Hd _ IH]; simpl in *; [ring |].
  rewrite IH, Rmin_right by assumption. ring.
Qed.

(** min(cᵢ, cⱼ) − m is a positive kernel for m ≤ all c: of springs A ⪰ ε min c, and only what presses counts. *)
Theorem least_of_two_is_positive m l : ascending l -> least m l -> 0 <= kernel m l l.
Proof.
  intros Ha; revert m. induction Ha as [| c x l Hc Ha IH]; intros m Hm; simpl; [lra |].
  inversion Hm as [| ? ? Hmc Hml]; subst; simpl in Hmc.
  rewrite kernel_of_one_more, (row_of_least m c l), Rmin_left by (assumption || lra).
  rewrite (kernel_shifts m c). specialize (IH c Hc).
  replace (_ + _) with ((c - m) * ((x + total l) * (x + total l)) + kernel c l l) by ring.
  pose proof (Rle_0_sqr (x + total l)) as Q; unfold Rsqr in Q.
  assert (0 <= (c - m) * ((x + total l) * (x + total l))) by (apply Rmult_le_pos; lra). lra.
Qed.

(** (d): each wall may keep the damping of its own, DA + AD is a sum of two such kernels. *)
Theorem two_lags (c d s t : R) :
  0 < s -> 0 < t -> c <= d -> c * s <= d * t -> c / s <= d / t ->
  (s + t) * Rmin c d = Rmin (c * s) (d * t) + s * t * Rmin (c / s) (d / t).
Proof. intros. rewrite !Rmin_left by assumption. field. lra. Qed.

(** Theorem 3 on the circle, p = sin²(θ/2), σ = a² = b² + 1: what is to be positive is so for κ (2a − b)² < 2. *)
Theorem circle (a b k p : R) :
  0 < b -> 0 < a -> a * a = b * b + 1 -> 0 < k -> k * ((2 * a - b) * (2 * a - b)) < 2 -> 0 < p <= 1 ->
  0 < (1 - p) * (2 * (a * a) - 2) - 8 * (a * a) * p * (1 - p) + 4 * p / k.
Proof.
  intros Hb Ha Hs Hk Hc [Hp H1].
  assert (2 * ((2 * a - b) * (2 * a - b)) < 4 / k).
  { apply Rmult_lt_reg_r with k; [assumption |]. replace (4 / k * k) with 4 by (field; lra). lra. }
  pose proof (Rle_0_sqr (2 * a * p - b)) as Q; unfold Rsqr in Q.
  assert (0 < p * (4 / k - 2 * ((2 * a - b) * (2 * a - b)))) by (apply Rmult_lt_0_compat; lra).
  replace (_ + _) with (2 * ((2 * a * p - b) * (2 * a * p - b)) +
                        p * (4 / k - 2 * ((2 * a - b) * (2 * a - b)))); [lra |].
  replace (2 * (a * a) - 2) with (2 * (b * b)) by lra. field. lra.
Qed.

(** Of two contacts of the same compliance, a the cosine that they share, a cap may leave one damper the share t of
    the other and they take energy all the same, whichever way they are moved. *)
Theorem capped_pair (a t x y : R) :
  a * a * ((1 + t) * (1 + t)) <= 4 * t -> 0 <= x * x + t * (y * y) + a * (1 + t) * (x * y).
Proof.
  intros H.
  pose proof (Rle_0_sqr (x + a * (1 + t) / 2 * y)) as Q; unfold Rsqr in Q.
  pose proof (Rle_0_sqr y) as Y; unfold Rsqr in Y.
  assert (0 <= (4 * t - a * a * ((1 + t) * (1 + t))) * (y * y)) by (apply Rmult_le_pos; lra).
  replace (_ + _) with ((x + a * (1 + t) / 2 * y) * (x + a * (1 + t) / 2 * y) +
                        (4 * t - a * a * ((1 + t) * (1 + t))) * (y * y) / 4) by field. lra.
Qed.

(** Theorem 4's inertia: of a mass m and a moment J about its centre, which is c off the handle, the handle has at least
    the share r of both at once; v is its speed, w its rate. *)
Theorem off_the_centre (m J c r v w : R) :
  0 < m -> 0 < r < 1 -> r * (m * (c * c)) = (1 - r) * (1 - r) * J ->
  r * (m * (v * v) + J * (w * w)) <= m * ((v - c * w) * (v - c * w)) + J * (w * w).
Proof.
  intros Hm [H0 H1] Hr.
  apply Rmult_le_reg_l with (1 - r); [lra |].
  pose proof (Rle_0_sqr ((1 - r) * v - c * w)) as Q; unfold Rsqr in Q.
  assert (0 <= m * (((1 - r) * v - c * w) * ((1 - r) * v - c * w))) by (apply Rmult_le_pos; lra).
  assert (E : (1 - r) * (1 - r) * J * (w * w) = r * (m * (c * c)) * (w * w)) by (rewrite Hr; ring).
  nra.
Qed.
