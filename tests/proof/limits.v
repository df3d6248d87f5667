(* SPDX-License-Identifier: BSD-3-Clause *)
(** What is no longer true if a rule is weakened, and how sharp the constants are: runs of one axis, with
    numbers. c = 1 N, p = 1 m and a damper of 1/800 J/m² in a tick; a light one, so that friction rules. *)

From Coq Require Import Reals Lra Lia List.
From passive_haptics Require Import vectors damping dual_ledger strict_bound presliding.
Import ListNotations.
Open Scope R_scope.

(** A vector of one axis. *)
Definition axis (x : R) : vec := fun _ => x.

Ltac by_numbers :=
  unfold rubbed, dissipated, charge, dot, sum, zero, axis in *;
  rewrite ?norm_one_axis in *; unfold add, sub, scale in *; simpl in *;
  unfold Rabs; repeat destruct (Rcase_abs _); lra.

Lemma no_error q : (forall i, 0 <= q i) -> in_box 1 q zero.
Proof. intros Q i _. specialize (Q i). unfold zero. rewrite Rabs_R0. lra. Qed.

Notation "u · v" := (dot 1 u v) (at level 40).
Definition damper : vec -> R := dissipated 1 (1 / 800) 0 1.
Definition outflow_of : vec -> R := worst_outflow 1 (1 / 800) 1 1.
Notation path := (path 1 zero 1 1 (1 / 2) (axis (-1)) (1 / 2) True).
Notation booked := (booked 1 zero 1 1 (1 / 2) 0 (axis (-1)) (1 / 2) True).
Notation value := (value 1 zero 1 1).
Notation loop := (loop 1 zero 1 1 (1 / 2) 0 (axis (-1)) (1 / 2) True outflow_of).

Lemma relaxed : deflected 1 1 1 (1 / 2) zero 0.
Proof. repeat split; by_numbers. Qed.
Lemma pulled : deflected 1 1 1 (1 / 2) (axis (-1)) (1 / 2).
Proof. repeat split; by_numbers. Qed.
Lemma pushed : deflected 1 1 1 (1 / 2) (axis 1) (1 / 2).
Proof. repeat split; by_numbers. Qed.

Lemma exact_positions : in_box 1 zero zero.
Proof. apply no_error. intros i. unfold zero. lra. Qed.

Lemma damper_only_loses d : 0 <= damper d.
Proof.
  unfold damper, dissipated, dot, sum. pose proof (Rle_0_sqr (d O)) as P; unfold Rsqr in P. lra.
Qed.

(** The device goes 2 m out, against the spring; with u = c the ledger holds 2cp − cp. *)
Definition out : event := seen damper (axis 2) zero.

Lemma out_path : path [out] zero (axis 1) (1 / 2) (5 / 1000).
Proof.
  eapply path_seen with (z := axis (-1)) (S := 1 / 2) (e := zero) (E := 0);
    [|exact exact_positions|exact pushed|unfold damper; by_numbers].
  apply path_start. exact exact_positions.
Qed.

Lemma out_booked : booked [out] 1 (axis 1) (axis 1).
Proof.
  pose proof (good_sample _ _ _ _ _ _ _ _ _ _ _ _ _ damper (axis 2) zero (axis 1) damper_only_loses
                (booked_start 1 zero 1 1 (1 / 2) 0 (axis (-1)) (1 / 2) True) ltac:(by_numbers)) as B.
  apply booked_turn with (s' := axis 1) (w' := axis 1) in B; [|by_numbers].
  eapply booked_lower; [exact B|]. by_numbers.
Qed.

(** ** The constant of presliding.v is sharp *)

(** Three ticks, the ledger at 0 J at first. Out: ½cp is sure, and the spring has that, nothing flowed in. A
    force pulls the device back by 20 m, 2 m of that on the spring; then the spring is let go. *)
Definition three_ticks : list event :=
  [seen damper (axis 1) zero; seen damper (axis (-20)) (axis (-105 / 100)); out].

Theorem three_ticks_lose_nearly_3cp :
  loop 0 three_ticks [] /\ exists E, path three_ticks zero zero 0 E /\ E <= - (299 / 100).
Proof.
  split.
  - assert (C : forall f, covered 1 1 outflow_of damper f).
    { intros f. exact (clamped 1 (1 / 800) 1 1 f ltac:(lra) ltac:(lra) ltac:(lra)). }
    unfold three_ticks.
    apply loop_tick with (pending := []) (answer := None) (oldest := None);
      [|now left|reflexivity|reflexivity|apply damper_only_loses|apply C].
    apply loop_tick with (pending := []) (answer := Some (axis (-105 / 100)))
      (oldest := Some (axis (-105 / 100)));
      [|right|reflexivity|apply Rle_refl|apply damper_only_loses|apply C].
    + apply loop_tick with (pending := []) (answer := None) (oldest := None);
        [|now left|reflexivity|reflexivity|apply damper_only_loses|apply C].
      apply loop_start.
    + exists (1 / 2). split.
      * intros e z S E P.
        pose proof (value_is_sure 1 zero 1 1 _ _ _ _ _ ltac:(lra) pulled _ _ _ _ out_booked e z S E P) as V.
        eapply Rle_trans; [right|exact V]. unfold presliding.value. by_numbers.
      * unfold outflow_of, worst_outflow, beyond, force_of. rewrite norm_one_axis. unfold axis.
        rewrite Rabs_left, Rmax_right by lra. simpl. lra.
  - exists (- (299375 / 100000)). split; [|lra]. unfold three_ticks.
    eapply path_seen with (z := axis (-1)) (S := 1 / 2) (e := zero) (E := - (2495 / 1000));
      [|exact exact_positions|exact relaxed|unfold damper; by_numbers].
    eapply path_seen with (z := axis 1) (S := 1 / 2) (e := zero) (E := 5 / 1000);
      [exact out_path|exact exact_positions|exact pulled|unfold damper; by_numbers].
Qed.

(** ** In debt not even friction's part of a force may be granted *)

(** Forces that friction alone would hold, W(f) = 0, held whatever the ledger says: each tick turns the
    spring round and takes nearly 2cp, for ever. *)
Theorem friction_granted_in_debt_loses_without_limit k :
  exists past z E, length past = k /\ (forall tick, In tick past -> outflow_of (held_in tick) = 0) /\
                   path past zero z (1 / 2) E /\ E <= - (199 / 100) * INR k.
Proof.
  assert (H : exists past z E, length past = k /\
            (forall tick, In tick past -> outflow_of (held_in tick) = 0) /\
            path past zero z (1 / 2) E /\ E <= - (199 / 100) * INR k /\ (z = axis 1 \/ z = axis (-1))).
  { assert (W : forall x, -1 <= x <= 1 -> outflow_of (axis x) = 0).
    { intros x Hx. unfold outflow_of, worst_outflow, beyond. rewrite norm_one_axis, Rmax_left; [lra|].
      unfold axis, Rabs. destruct (Rcase_abs x); lra. }
    induction k as [|k [past [z [E [L [F [P [B Z]]]]]]]].
    - exists [], (axis (-1)), 0.
      repeat split; [intros ? []|apply path_start, exact_positions|simpl; lra|auto].
    - rewrite S_INR. destruct Z as [-> | ->].
      + exists (seen damper (axis (-2)) (axis (-1)) :: past), (axis (-1)), (E - 1995 / 1000).
        simpl length. split; [congruence|]. split; [|split; [|split; [lra|auto]]].
        * intros tick [<-|I]; [apply W; lra|auto].
        * eapply path_seen; [exact P|exact exact_positions|exact pulled|]. unfold damper. by_numbers.
      + exists (seen damper (axis 2) (axis 1) :: past), (axis 1), (E - 1995 / 1000).
        simpl length. split; [congruence|]. split; [|split; [|split; [lra|auto]]].
        * intros tick [<-|I]; [apply W; lra|auto].
        * eapply path_seen; [exact P|exact exact_positions|exact pushed|]. unfold damper. by_numbers. }
  destruct H as [past [z [E [L [F [P [B _]]]]]]]. exists past, z, E. auto.
Qed.

(** ** To let go of a share w costs p|w|, not what the sure ledger takes off for it *)

(** After the way out, w ← 0 with A ← A − p|w|²/(2c) would stand nearly ½cp above the energy. *)
Theorem letting_go_for_less_overstates :
  exists past A s w z S E, booked past A s w /\ path past zero z S E /\
                           0 + 1 / 2 + E + 495 / 1000 <= value A s w + s · zero - zero · z + S.
Proof.
  exists [out], 1, (axis 1), (axis 1), (axis 1), (1 / 2), (5 / 1000).
  split; [exact out_booked|]. split; [exact out_path|]. unfold presliding.value. by_numbers.
Qed.

(** ** A late tick must let go of friction's share *)

(** Late ticks with f = c in which nothing has moved in the end: within T the force pulls the device over
    2p of spring; then it is dropped, and the spring's motion back costs nothing. *)
Definition late_tick_at_rest : event := late damper damper zero (axis 1).

Theorem late_ticks_lose_nearly_2cp_each k :
  path (repeat late_tick_at_rest k) zero (axis (-1)) (1 / 2) (- (1995 / 1000) * INR k).
Proof.
  induction k as [|k IH].
  - simpl repeat. replace (- (1995 / 1000) * INR 0) with 0 by (simpl; lra).
    apply path_start, exact_positions.
  - rewrite S_INR. simpl repeat. apply path_dropped. unfold force_free.
    eapply path_unseen with (d := axis (-2)) (z := axis 1) (S := 1 / 2) (e := zero)
      (E := - (1995 / 1000) * INR k - 1995 / 1000); [|exact exact_positions|exact pulled|by_numbers].
    eapply path_unseen with (d := axis 2); [exact IH|exact exact_positions|exact pushed|].
    unfold damper. by_numbers.
Qed.

(** The smaller of the update and of what a lost sample would leave, u = û = w = f, loses nothing. *)
Theorem late_tick_that_keeps_the_share_sees_nothing A (f : vec) :
  let s := (f - f)%V in
  Rmin (A + (f - f)%V · zero - charge 1 zero (s + f - f)%V - 1 * norm 1 (f - f)%V - charge 1 zero s)
       (A - charge 1 zero s - 0 - 1 * norm 1 (f - f)%V) = A.
Proof.
  simpl. rewrite dot_zero_r, norm_no_difference.
  assert (Z : forall v, charge 1 zero v = 0) by (intros v; unfold charge, sum, zero; lra).
  rewrite !Z, Rmin_left; lra.
Qed.

(** ** And of its slope *)

(** Without friction, q = 2 m, a loan L, h(Δ) = Δ² and f = 2 N in a late tick that shows −1 m: to keep the
    update because its sure value is the smaller of the two keeps A = L, σ = −2, and at e = −1 that
    ledger stands 3 J above the energy of a force that was dropped. *)
Theorem late_tick_that_keeps_the_slope_overstates L :
  let h := dissipated 1 1 0 1 in
  let held := axis 2 in let shown := axis (-1) in let box := axis 2 in
  let A := L + (zero - held)%V · shown - 0 - charge 1 box (zero + held - zero)%V in
  let s := (zero - held)%V in
  dual_ledger.value 1 box A s <= dual_ledger.value 1 box L zero - worst_outflow 1 1 0 1 held /\
  exists e E, dual_ledger.path 1 box True [late h h shown held] e E /\ A + s · e = L + E + 3.
Proof.
  simpl. split.
  - unfold dual_ledger.value, worst_outflow, beyond. rewrite norm_one_axis. unfold charge, dot, sum.
    unfold zero, axis, add, sub. unfold Rabs, Rmax.
    repeat destruct (Rcase_abs _); repeat destruct (Rle_dec _ _); lra.
  - assert (B : in_box 1 (axis 2) (axis (-1))).
    { intros i _. unfold axis. rewrite Rabs_left; lra. }
    exists (axis (-1)), (-1). split; [|by_numbers].
    apply dual_ledger.path_dropped. unfold force_free.
    eapply dual_ledger.path_unseen with (d := zero) (E := -1);
      [|exact B|by_numbers].
    eapply dual_ledger.path_unseen with (d := axis 1) (e := axis (-1)) (E := 0);
      [apply dual_ledger.path_start; exact B|exact B|].
    by_numbers.
Qed.
