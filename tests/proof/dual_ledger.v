(* SPDX-License-Identifier: BSD-3-Clause *)
(** The dual ledger: what has flowed in at least, from positions that are only known to a box.

    The position shown is x̂ = x − e, with |eᵢ| ≤ qᵢ/2 at every sample and nothing else known of e. In a
    tick in which the device moves by Δ it dissipates at least h(Δ). For ANY choice of u in each tick,

        A ← A + (u − f)·Δx̂ − h*(u) − ½ Σ qᵢ|σᵢ + fᵢ − uᵢ|        σ ← u − f

    and A + σ·e is at most the energy of every true path that ends at the error e. So the sure ledger
    A − ½ Σ qᵢ|σᵢ| is at most the energy at the port, in any dimension and after any number of ticks.

    What is assumed: h bounds the loss of each tick from below, the box holds at every good sample, and
    f is the force that was held. Nothing is assumed of the hand, the environment or the choice of u,
    and h need not be convex: a worse u only makes a lower ledger. *)

From Coq Require Import Reals Lra Lia List.
From passive_haptics Require Import vectors damping.
Import ListNotations.
Open Scope R_scope.

(** What a tick shows. Histories are lists of these, the newest first. *)
Inductive event :=
| seen (h : vec -> R) (shown held : vec)
    (** a good sample: the loss h of a tick of this length, Δx̂, the force held *)
| unseen (h : vec -> R) (held : vec)
    (** a lost sample, or the first good one after some: the motion is not known *)
| late (h h_longest : vec -> R) (shown held : vec)
    (** a tick longer than T: a watchdog may have dropped the force within T, or not *).

(** Without a force, and without any loss that one could count on. *)
Definition force_free : event := unseen (fun _ => 0) zero.

Section dual_ledger.
Variable n : nat.
Variable q : vec.        (** the box: steps of the encoders, or bounds of the noise [m] *)
Variable loan : R.       (** [J] *)
Variable watchdog : Prop.  (** the device drops a force by itself within T of the last command *)
Notation "u · v" := (dot n u v) (at level 40).

(** ** True paths *)

(** [path past e E]: on some true path that looked like [past], the error is now e and E [J] have flowed
    in. A lost sample has no error; any in the box stands for it. *)
Inductive path : list event -> vec -> R -> Prop :=
| path_start e : in_box n q e -> path [] e 0
| path_seen past e E h shown held e' E' :
    path past e E -> in_box n q e' ->
    E + h (shown + e' - e)%V - held · (shown + e' - e)%V <= E' ->
    path (seen h shown held :: past) e' E'
| path_unseen past e E h held d e' E' :
    path past e E -> in_box n q e' ->
    E + h d - held · d <= E' ->
    path (unseen h held :: past) e' E'
| path_held_to_the_end past h h_longest shown held e E :
    ~ watchdog ->
    path (seen h shown held :: past) e E ->
    path (late h h_longest shown held :: past) e E
| path_dropped past h h_longest shown held e E :
    path (force_free :: unseen h_longest held :: past) e E ->
    path (late h h_longest shown held :: past) e E.

(** ** The ledger *)

(** [booked past A σ]: A and σ can have been booked after [past]. In every tick u is free, and k is h*(u)
    or more. A late tick leaves what is sure in both of its cases. A may be lowered at any time, by a cap
    (L7) or by rounding, σ may be changed for the charge of the change, and whatever else is known to be
    sure may take their place. *)
Inductive booked : list event -> R -> vec -> Prop :=
| booked_start : booked [] loan zero
| booked_seen past A s h shown held u k :
    booked past A s -> conjugate_at_most n h u k ->
    booked (seen h shown held :: past)
      (A + (u - held)%V · shown - k - charge n q (s + held - u)%V) (u - held)%V
| booked_unseen past A s h held k :
    booked past A s -> conjugate_at_most n h held k ->
    booked (unseen h held :: past) (A - charge n q s - k) zero
| booked_late past A s h h_longest shown held :
    booked (seen h shown held :: past) A s ->
    booked (force_free :: unseen h_longest held :: past) A s ->
    booked (late h h_longest shown held :: past) A s
| booked_lower past A A' s : booked past A s -> A' <= A -> booked past A' s
| booked_turn past A s s' :
    booked past A s -> booked past (A - charge n q (s' - s)%V) s'
| booked_known past A s :
    (forall e E, path past e E -> A + s · e <= loan + E) -> booked past A s.

(** The sure ledger [J]. *)
Definition value (A : R) (s : vec) : R := A - charge n q s.

(** ** The theorem *)

Lemma path_in_box past e E : path past e E -> in_box n q e.
Proof. induction 1; assumption. Qed.

(** One tick: Fenchel-Young, and the least of (σ + f − u)·e over the box. *)
Lemma one_tick A s h shown held u k e e' :
  conjugate_at_most n h u k -> in_box n q e ->
  A + (u - held)%V · shown - k - charge n q (s + held - u)%V + (u - held)%V · e' <=
  A + s · e + h (shown + e' - e)%V - held · (shown + e' - e)%V.
Proof.
  intros K B. specialize (K (shown + e' - e)%V).
  pose proof (charge_covers n q (s + held - u)%V e B). expand. lra.
Qed.

Theorem dual_ledger past A s :
  booked past A s -> forall e E, path past e E -> A + s · e <= loan + E.
Proof.
  induction 1 as [|past A s h shown held u k _ IH K|past A s h held k _ IH K
                  |past A s h h_longest shown held _ IHseen _ IHdropped
                  |past A A' s _ IH L|past A s s' _ IH|past A s K]; intros e E P.
  - inversion P; subst. expand. lra.
  - inversion P as [|past' e0 E0 h' shown' held' e' E' P0 B L| | |]; subst.
    specialize (IH e0 E0 P0). pose proof (path_in_box _ _ _ P0) as B0.
    pose proof (one_tick A s h shown held u k e0 e K B0). lra.
  - inversion P as [| |past' e0 E0 h' held' d e' E' P0 B L| |]; subst.
    specialize (IH e0 E0 P0). specialize (K d).
    pose proof (charge_covers n q s e0 (path_in_box _ _ _ P0)). expand. lra.
  - inversion P; subst; auto.
  - specialize (IH e E P). lra.
  - specialize (IH e E P).
    pose proof (charge_suffices n q (s' - s)%V e (path_in_box _ _ _ P)). expand. lra.
  - auto.
Qed.

(** The sure ledger is never above loan + E, whatever the errors were. *)
Theorem value_is_sure past A s :
  booked past A s -> forall e E, path past e E -> value A s <= loan + E.
Proof.
  intros B e E P. pose proof (dual_ledger past A s B e E P).
  pose proof (charge_covers n q s e (path_in_box _ _ _ P)). unfold value. lra.
Qed.

(** And it is the least of A + σ·e over the box: no more could be read from A and σ. *)
Theorem value_is_the_least_of_the_box A s :
  (forall i, (i < n)%nat -> 0 <= q i) -> exists e, in_box n q e /\ A + s · e = value A s.
Proof.
  intros Q. destruct (charge_is_taken n q s Q) as [e [B E]].
  exists e. split; [assumption|]. unfold value. lra.
Qed.

(** Several ledgers of the same history, each with its own u: the larger of two values is sure, and so is
    the largest of many. *)
Theorem larger_of_two past A s A' s' :
  booked past A s -> booked past A' s' ->
  forall e E, path past e E -> Rmax (value A s) (value A' s') <= loan + E.
Proof. intros B B' e E P. apply Rmax_lub; eapply value_is_sure; eassumption. Qed.

(** ** The rules of the code *)

(** A lost sample: A ← (sure ledger) − h*(f), σ ← 0, with h* of the longest tick. *)
Theorem lost_sample past A s h held k :
  booked past A s -> conjugate_at_most n h held k ->
  booked (unseen h held :: past) (value A s - k) zero.
Proof. intros B K. exact (booked_unseen past A s h held k B K). Qed.

(** A late tick: A ← min of both sure values, σ ← 0. *)
Theorem late_tick past A s h h_longest shown held u k k_longest A' :
  booked past A s -> conjugate_at_most n h u k -> conjugate_at_most n h_longest held k_longest ->
  A' = A + (u - held)%V · shown - k - charge n q (s + held - u)%V ->
  booked (late h h_longest shown held :: past)
    (Rmin (value A' (u - held)%V) (value A s - k_longest)) zero.
Proof.
  intros B K L ->. set (A' := A + _ - _ - _). apply booked_late.
  - apply booked_lower with (A' - charge n q (zero - (u - held))%V).
    + apply booked_turn. now apply booked_seen.
    + rewrite charge_opposite. apply Rmin_l.
  - apply booked_lower with (A - charge n q s - k_longest - charge n q zero - 0).
    + apply booked_unseen; [now apply booked_unseen|]. intros d. expand. lra.
    + eapply Rle_trans; [apply Rmin_r|]. unfold value. rewrite charge_zero. lra.
Qed.

(** c = 0, u = 0: Abel's summation by parts, as in [quantised_energy]; a change of the force costs
    ½ Σ qᵢ|fᵢ − f'ᵢ|, f' the force before. *)
Theorem summation_by_parts past A last h shown held :
  (forall d, 0 <= h d) -> booked past A (zero - last)%V ->
  booked (seen h shown held :: past)
    (A - held · shown - charge n q (held - last)%V) (zero - held)%V.
Proof.
  intros H B.
  replace (A - held · shown - charge n q (held - last)%V)
    with (A + (zero - held)%V · shown - 0 - charge n q (zero - last + held - zero)%V).
  - apply booked_seen; [assumption|]. intros d. specialize (H d). expand. lra.
  - expand. f_equal; [lra|]. apply sum_ext; intros i _. unfold add, sub, zero. do 2 f_equal. lra.
Qed.
End dual_ledger.

(** q = 0, u = ∇h(Δx̂): the thesis's own ledger, E1 ← E1 + Δxᵀ(b/T)Δx + c|Δx| − f·Δx. *)
Theorem reduced_energy n loan watchdog past A s b c T shown held :
  0 < b -> 0 < T -> 0 <= c -> booked n zero loan watchdog past A s ->
  exists s', booked n zero loan watchdog (seen (dissipated n b c T) shown held :: past)
               (A + dissipated n b c T shown - dot n held shown) s'.
Proof.
  intros Hb HT Hc B. set (D := norm n shown).
  assert (0 <= D) by apply norm_not_negative.
  assert (Z : forall v, charge n zero v = 0).
  { intros v. unfold charge. rewrite <- (sum_zero n). apply sum_ext; intros; unfold zero; lra. }
  destruct (Req_dec D 0) as [N|N].
  - exists (zero - held)%V.
    replace (A + dissipated n b c T shown - dot n held shown)
      with (A + dot n (zero - held)%V shown - 0 - charge n zero (s + held - zero)%V).
    + apply booked_seen; [assumption|]. intros d. unfold dissipated. expand.
      pose proof (dot_self n d). pose proof (norm_not_negative n d).
      assert (0 < / T) by (now apply Rinv_0_lt_compat). unfold Rdiv.
      assert (0 <= b * dot n d d) by nra. nra.
    + rewrite Z. unfold dissipated. rewrite <- norm_square. fold D. rewrite N. expand. field; lra.
  - set (a := 2 * b / T + c / D).
    assert (0 <= a).
    { unfold a, Rdiv. assert (0 < / T) by (now apply Rinv_0_lt_compat).
      assert (0 < / D) by (apply Rinv_0_lt_compat; lra). nra. }
    exists (a * shown - held)%V.
    replace (A + dissipated n b c T shown - dot n held shown)
      with (A + dot n (a * shown - held)%V shown - worst_outflow n b c T (a * shown)%V -
            charge n zero (s + held - a * shown)%V).
    + apply booked_seen; [assumption|]. now apply worst_tick.
    + rewrite Z. unfold worst_outflow, dissipated. rewrite norm_scale, dot_sub_l, dot_scale_l by assumption.
      rewrite <- norm_square. fold D.
      assert (E : beyond c (a * D) = 2 * b * D / T).
      { unfold beyond. replace (a * D - c) with (2 * b * D / T) by (unfold a; field; lra).
        apply Rmax_right. unfold Rdiv. assert (0 < / T) by (now apply Rinv_0_lt_compat).
        apply Rmult_le_pos; nra. }
      rewrite E. unfold a. field. lra.
Qed.
