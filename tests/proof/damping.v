(* SPDX-License-Identifier: BSD-3-Clause *)
(** What a tick dissipates at least, and what a force can take out in it at most.

    The device loses at least h(Δ) in a tick in which it moves by Δ. All later proofs know of h only
    bounds of its conjugate h*(u) = sup u·Δ − h(Δ), which is the largest energy that the force u can
    hand out in the tick: lemma L3 of docs/design/mathematics.md § 1, with its friction credit of § 2.
    This file proves those bounds for the damping policies of device/damping.hpp, that they are the
    least possible, and lemma L1: that a tick of continuous motion dissipates h(Δ) at least. *)

From Coq Require Import Reals Lra Lia.
From passive_haptics Require Import vectors.
Open Scope R_scope.

(** k is at least h*(u): the inequality of Fenchel and Young. *)
Definition conjugate_at_most (n : nat) (h : vec -> R) (u : vec) (k : R) : Prop :=
  forall d, dot n u d - k <= h d.

(** What exceeds c, (x − c)₊. *)
Definition beyond (c x : R) : R := Rmax 0 (x - c).

Section damping.
Variable n : nat.
Notation "u · v" := (dot n u v) (at level 40).
Notation "| u |" := (norm n u) (at level 30, u at level 99).

(** ** The policies of device/damping.hpp *)

(** b|Δ|²/T + c|Δ|: [damping_and_friction::dissipated], and [isotropic_damping] with c = 0. *)
Definition dissipated (b c T : R) (d : vec) : R := b * (d · d) / T + c * norm n d.

(** T(|f| − c)₊²/(4b): [worst_outflow]. *)
Definition worst_outflow (b c T : R) (f : vec) : R :=
  T * (beyond c (norm n f) * beyond c (norm n f)) / (4 * b).

(** Σ bᵢΔᵢ²/T and T Σ fᵢ²/(4bᵢ): [diagonal_damping]. *)
Definition dissipated_by_axes (b : vec) (T : R) (d : vec) : R :=
  sum n (fun i => b i * (d i * d i) / T).
Definition worst_outflow_by_axes (b : vec) (T : R) (f : vec) : R :=
  sum n (fun i => T * (f i * f i) / (4 * b i)).

(** ** L3, the worst tick *)

(** F s ≤ B s² + F²/(4B), by completing the square. *)
Lemma worst_travel (b T F s : R) : 0 < b -> 0 < T -> F * s <= b * (s * s) / T + T * (F * F) / (4 * b).
Proof.
  intros Hb HT.
  apply Rminus_le. replace (F * s - (b * (s * s) / T + T * (F * F) / (4 * b)))
    with (- ((2 * b * s - T * F) * (2 * b * s - T * F)) / (4 * b * T)) by (field; lra).
  assert (0 < / (4 * b * T)) by (apply Rinv_0_lt_compat; nra).
  pose proof (Rle_0_sqr (2 * b * s - T * F)) as P; unfold Rsqr in P. unfold Rdiv. nra.
Qed.

Lemma worst_outflow_not_negative b c T f : 0 < b -> 0 < T -> 0 <= worst_outflow b c T f.
Proof.
  intros Hb HT. unfold worst_outflow, Rdiv.
  assert (0 < / (4 * b)) by (apply Rinv_0_lt_compat; lra).
  pose proof (Rle_0_sqr (beyond c (norm n f))) as P; unfold Rsqr in P.
  apply Rmult_le_pos; [apply Rmult_le_pos|]; lra.
Qed.

(** L3 with friction: no motion takes more than [worst_outflow] from what a tick dissipates. *)
Theorem worst_tick b c T f :
  0 < b -> 0 < T -> conjugate_at_most n (dissipated b c T) f (worst_outflow b c T f).
Proof.
  intros Hb HT d. unfold dissipated, worst_outflow.
  pose proof (cauchy_schwarz n f d). rewrite <- norm_square.
  pose proof (norm_not_negative n d).
  pose proof (worst_travel b T (beyond c (norm n f)) (norm n d) Hb HT).
  assert (norm n f <= c + beyond c (norm n f))
    by (unfold beyond; pose proof (Rmax_r 0 (norm n f - c)); lra).
  nra.
Qed.

(** It is the least such number: a motion along the force takes all of it. *)
Theorem worst_tick_is_reached b c T f :
  0 < b -> 0 < T -> 0 <= c ->
  exists d, f · d - dissipated b c T d = worst_outflow b c T f.
Proof.
  intros Hb HT Hc. unfold dissipated, worst_outflow, beyond.
  destruct (Rle_lt_dec (norm n f) c) as [S|S].
  - exists zero. rewrite Rmax_left by lra. expand. rewrite norm_zero. field; lra.
  - rewrite Rmax_right by lra.
    set (F := norm n f) in *. set (a := T * (F - c) / (2 * b * F)).
    assert (0 <= a).
    { unfold a, Rdiv. apply Rmult_le_pos; [nra|].
      apply Rlt_le, Rinv_0_lt_compat. nra. }
    exists (a * f)%V. expand. rewrite norm_scale by assumption. rewrite <- norm_square.
    fold F. unfold a. field. lra.
Qed.

(** A shorter tick dissipates more and can cost less: T is the longest that the loop can produce. *)
Theorem shorter_ticks b c t T d : 0 <= b -> 0 < t <= T -> dissipated b c T d <= dissipated b c t d.
Proof.
  intros Hb [Ht HT]. unfold dissipated.
  assert (/ T <= / t) by (apply Rinv_le_contravar; lra).
  pose proof (dot_self n d). assert (0 <= b * dot n d d) by nra. unfold Rdiv. nra.
Qed.

(** L3 axis by axis: ¼ fᵀB⁻¹f for unequal axes. *)
Theorem worst_tick_by_axes b T f :
  (forall i, 0 < b i) -> 0 < T ->
  conjugate_at_most n (dissipated_by_axes b T) f (worst_outflow_by_axes b T f).
Proof.
  intros Hb HT d. unfold dissipated_by_axes, worst_outflow_by_axes.
  apply Rplus_le_reg_r with (sum n (fun i => T * (f i * f i) / (4 * b i))).
  rewrite <- sum_add. unfold Rminus. rewrite Rplus_assoc, Rplus_opp_l, Rplus_0_r.
  apply sum_le; intros i _. apply worst_travel; auto.
Qed.

(** Dry friction alone pays for every force of at most c. *)
Lemma friction_pays c u : norm n u <= c -> conjugate_at_most n (fun d => c * norm n d) u 0.
Proof. intros H d. pose proof (dot_at_most n u d c H). lra. Qed.

(** What a force costs is what is left of it beyond the ball |w| ≤ c, at a friction that takes w. *)
Lemma clamped b c T f :
  0 < b -> 0 < T -> 0 <= c ->
  exists w, norm n w <= c /\
            conjugate_at_most n (dissipated b 0 T) (f - w)%V (worst_outflow b c T f).
Proof.
  intros Hb HT Hc. destruct (Rle_lt_dec (norm n f) c) as [S|S].
  - exists f. split; [assumption|]. intros d.
    pose proof (worst_tick b 0 T zero Hb HT d) as P. pose proof (worst_outflow_not_negative b c T f Hb HT).
    assert (Z : worst_outflow b 0 T zero = 0).
    { unfold worst_outflow, beyond. rewrite norm_zero, Rmax_left by lra. field; lra. }
    rewrite Z in P. expand. lra.
  - set (F := norm n f) in *. assert (0 <= c / F <= 1) as [P0 P1].
    { assert (0 < / F) by (apply Rinv_0_lt_compat; lra).
      assert (F * / F = 1) by (apply Rinv_r; lra). unfold Rdiv. nra. }
    exists (c / F * f)%V. split.
    + rewrite norm_scale by assumption. fold F. right; field; lra.
    + assert (N : norm n (f - c / F * f)%V = F - c).
      { replace (norm n (f - c / F * f)%V) with (norm n ((1 - c / F) * f)%V)
          by (unfold norm; f_equal; apply sum_ext; intros; unfold sub, scale; ring).
        rewrite norm_scale by lra. fold F. field. lra. }
      pose proof (worst_tick b 0 T (f - c / F * f)%V Hb HT) as P.
      intros d. specialize (P d). unfold worst_outflow in *. rewrite N in P. fold F.
      replace (beyond 0 (F - c)) with (beyond c F) in P by (unfold beyond; f_equal; lra). exact P.
Qed.
End damping.

(** ** L1, the damping credit *)

(** A tick of continuous motion, from [start] to [stop], at the velocity v(t). *)
Section tick.
Variable n : nat.
Variables start stop : R.
Variable v : R -> vec.
Variable power : R -> R.
Hypothesis forwards : start < stop.
Hypothesis velocity_integrable : forall i, Riemann_integrable (fun t => v t i) start stop.
Hypothesis power_integrable : Riemann_integrable power start stop.

Definition travel : vec := fun i => RiemannInt (velocity_integrable i).
Definition lost : R := RiemannInt power_integrable.

(** ∫ u·v dt = u·Δ for a constant u. *)
Lemma work_of_constant_force m (u : vec) :
  { pr : Riemann_integrable (fun t => dot m u (v t)) start stop | RiemannInt pr = dot m u travel }.
Proof.
  induction m as [|m [pr E]].
  - pose (nothing := RiemannInt_P14 start stop 0).
    exists nothing. pose proof (RiemannInt_P15 nothing) as P. rewrite Rmult_0_l in P. exact P.
  - pose (both := RiemannInt_P10 (u m) pr (velocity_integrable m)).
    exists both. pose proof (RiemannInt_P13 pr (velocity_integrable m) both) as P.
    rewrite E in P. exact P.
Qed.

(** What holds of the power at every moment, P ≥ u·v − k, holds of the tick. *)
Lemma power_to_energy (u : vec) (k : R) :
  (forall t, start < t < stop -> dot n u (v t) - k <= power t) ->
  dot n u travel - k * (stop - start) <= lost.
Proof.
  intros H. destruct (work_of_constant_force n u) as [pr E].
  pose (pr' := RiemannInt_P10 (- k) pr (RiemannInt_P14 start stop 1)).
  assert (I : RiemannInt pr' = dot n u travel - k * (stop - start)).
  { rewrite (RiemannInt_P13 pr (RiemannInt_P14 start stop 1) pr'), RiemannInt_P15, E. ring. }
  rewrite <- I. apply RiemannInt_P19; [lra|]. intros t Ht. unfold fct_cte. specialize (H t Ht). lra.
Qed.

(** L1 with dry friction: a damper and a friction that hold at least b|v|² + c|v| [W] at every moment
    dissipate at least b|Δ|²/T + c|Δ| in the tick, whatever the path. *)
Theorem damping_credit b c :
  0 < b -> 0 <= c ->
  (forall t, start < t < stop -> b * dot n (v t) (v t) + c * norm n (v t) <= power t) ->
  dissipated n b c (stop - start) travel <= lost.
Proof.
  intros Hb Hc H. set (T := stop - start). assert (0 < T) by (unfold T; lra).
  set (D := norm n travel). assert (0 <= D) by apply norm_not_negative.
  assert (P : forall u, dot n u travel - worst_outflow n b c 1 u * T <= lost).
  { intros u. apply power_to_energy. intros t Ht. specialize (H t Ht).
    pose proof (worst_tick n b c 1 u Hb Rlt_0_1 (v t)) as W. unfold dissipated in W. lra. }
  unfold dissipated. rewrite <- norm_square. fold D.
  destruct (Req_dec D 0) as [Z|Z].
  - specialize (P zero). unfold worst_outflow, beyond in P.
    rewrite norm_zero, Rmax_left, dot_zero_l in P by lra. rewrite Z.
    replace (b * (0 * 0) / T + c * 0) with 0 by (field; lra). unfold Rdiv in P. lra.
  - set (a := 2 * b / T + c / D).
    assert (0 <= a).
    { unfold a, Rdiv. assert (0 < / T) by (now apply Rinv_0_lt_compat).
      assert (0 < / D) by (apply Rinv_0_lt_compat; lra). nra. }
    specialize (P (a * travel)%V). unfold worst_outflow in P.
    rewrite norm_scale, dot_scale_l, <- norm_square in P by assumption. fold D in P.
    assert (B : beyond c (a * D) = 2 * b * D / T).
    { unfold beyond. replace (a * D - c) with (2 * b * D / T) by (unfold a; field; lra).
      apply Rmax_right. unfold Rdiv. assert (0 < / T) by (now apply Rinv_0_lt_compat).
      apply Rmult_le_pos; nra. }
    rewrite B in P.
    replace (b * (D * D) / T + c * D)
      with (a * (D * D) - 1 * (2 * b * D / T * (2 * b * D / T)) / (4 * b) * T)
      by (unfold a; field; lra). exact P.
Qed.
End tick.
