(* SPDX-License-Identifier: BSD-3-Clause *)
(** The dual ledger with friction that is elastic before it slides.

    Friction of presliding is a spring in series with a slider: z is the spring's deflection, S the
    energy it stores, and the slider moves by Δ − (z' − z) in a tick in which the device moves by Δ. The
    device loses S' − S + c|Δ − (z' − z)| to it, and h(Δ) to its damper. With |z| ≤ p, any u and any
    share w of it, |w| ≤ c, that the friction is to pay for,

        A ← A + (u − f)·Δx̂ − h*(u − w) − ½ Σ qᵢ|σᵢ + fᵢ − uᵢ| − p|w − w_last|,    σ ← u − f
        sure ledger = A − ½ Σ qᵢ|σᵢ| − p|w|²/(2c)

    The sure ledger is at most loan + S₀ + E, where E has flowed in and S₀ is what the spring held at the
    start. A bound that spends it counts on friction that it may not get: 2cp in each tick that holds a
    force, while the spring turns round, and M, the most that the spring can hold, once. With k ticks of
    latency, and no force at all where the ledger does not cover it,

        E ≥ −loan − S₀ − M − 2(k + 1)cp.

    So a ledger that starts at −M − 2(k + 1)cp gives E ≥ −S₀. Of one slider, and of any number of them side
    by side, M = ½cp: without latency the ledger starts at −2.5cp, and −S₀ ≥ −½cp is all that is left.
    Started at 0 it would give E ≥ −3cp, and limits.v comes that near.

    c = p = 0 is the theorem of dual_ledger.v. Any dimension; |·| is the Euclidean norm. *)

From Coq Require Import Reals Lra Lia List.
From passive_haptics Require Import vectors damping dual_ledger strict_bound.
Import ListNotations.
Open Scope R_scope.

(** ** What is assumed of the friction *)

(** A state (z, S) of the friction, with the bounds c, p and M of the text above. The spring is nowhere
    softer than that of a slider, c/p, and so holds at least ½ (c/p)|z|². *)
Definition deflected (n : nat) (c p M : R) (z : vec) (S : R) : Prop :=
  norm n z <= p /\ c * dot n z z <= 2 * p * S /\ 0 <= S <= M.

(** What the friction takes in a tick, stored or lost [J]. *)
Definition rubbed (n : nat) (c : R) (d z z' : vec) (S S' : R) : R :=
  S' - S + c * norm n (d - (z' - z))%V.

Section presliding.
Variable n : nat.
Variable q : vec.          (** the box [m] *)
Variables c p M : R.       (** friction [N], presliding displacement [m], most stored energy [J] *)
Variable loan : R.         (** where the ledger starts; below zero, a reserve [J] *)
Variables (z0 : vec) (S0 : R).  (** the friction's state at the start *)
Variable watchdog : Prop.
Hypothesis friction : 0 <= c.
Hypothesis start_deflected : deflected n c p M z0 S0.
Notation "u · v" := (dot n u v) (at level 40).

(** ** True paths *)

(** [path past e z S E]: on some true path that looked like [past] the error is e, the friction is at
    (z, S), and E [J] have flowed in at the port. h is the loss of the damper alone. *)
Inductive path : list event -> vec -> vec -> R -> R -> Prop :=
| path_start e : in_box n q e -> path [] e z0 S0 0
| path_seen past e z S E h shown held e' z' S' E' :
    path past e z S E -> in_box n q e' -> deflected n c p M z' S' ->
    E + h (shown + e' - e)%V + rubbed n c (shown + e' - e)%V z z' S S'
      - held · (shown + e' - e)%V <= E' ->
    path (seen h shown held :: past) e' z' S' E'
| path_unseen past e z S E h held d e' z' S' E' :
    path past e z S E -> in_box n q e' -> deflected n c p M z' S' ->
    E + h d + rubbed n c d z z' S S' - held · d <= E' ->
    path (unseen h held :: past) e' z' S' E'
| path_held_to_the_end past h h_longest shown held e z S E :
    ~ watchdog ->
    path (seen h shown held :: past) e z S E ->
    path (late h h_longest shown held :: past) e z S E
| path_dropped past h h_longest shown held e z S E :
    path (force_free :: unseen h_longest held :: past) e z S E ->
    path (late h h_longest shown held :: past) e z S E.

(** ** The ledger *)

(** [booked past A σ w]: as in dual_ledger.v, with w the share of the friction in the last tick's u. *)
Inductive booked : list event -> R -> vec -> vec -> Prop :=
| booked_start : booked [] loan zero zero
| booked_seen past A s w h shown held u w' k :
    booked past A s w -> norm n w' <= c -> conjugate_at_most n h (u - w')%V k ->
    booked (seen h shown held :: past)
      (A + (u - held)%V · shown - k - charge n q (s + held - u)%V - p * norm n (w' - w)%V)
      (u - held)%V w'
| booked_unseen past A s w h held w' k :
    booked past A s w -> norm n w' <= c -> conjugate_at_most n h (held - w')%V k ->
    booked (unseen h held :: past)
      (A - charge n q s - k - p * norm n (w' - w)%V) zero w'
| booked_late past A s w h h_longest shown held :
    booked (seen h shown held :: past) A s w ->
    booked (force_free :: unseen h_longest held :: past) A s w ->
    booked (late h h_longest shown held :: past) A s w
| booked_lower past A A' s w : booked past A s w -> A' <= A -> booked past A' s w
| booked_turn past A s w s' w' :
    booked past A s w -> norm n w' <= c ->
    booked past (A - charge n q (s' - s)%V - p * norm n (w' - w)%V) s' w'
| booked_known past A s w :
    norm n w <= c ->
    (forall e z S E, path past e z S E -> A + s · e - w · z + S <= loan + S0 + E) ->
    booked past A s w.

(** The sure ledger [J]; without friction w is zero and so is its last term. *)
Definition value (A : R) (s w : vec) : R := A - charge n q s - p * (norm n w * norm n w) / (2 * c).

(** ** The theorem *)

Lemma p_not_negative : 0 <= p.
Proof. destruct start_deflected as [H _]. pose proof (norm_not_negative n z0). lra. Qed.

Lemma path_in_box past e z S E : path past e z S E -> in_box n q e.
Proof. induction 1; assumption. Qed.

Lemma path_deflected past e z S E : path past e z S E -> deflected n c p M z S.
Proof. induction 1; assumption. Qed.

Lemma booked_within_friction past A s w : booked past A s w -> norm n w <= c.
Proof. induction 1; try assumption. rewrite norm_zero. lra. Qed.

(** Summing w·(z' − z) by parts costs p|w' − w| in a tick. *)
Lemma change_of_friction z w w' : norm n z <= p -> - (p * norm n (w' - w)%V) <= w' · z - w · z.
Proof.
  intros H. pose proof (dot_at_least n z (w' - w)%V p H) as P.
  rewrite dot_sym in P. expand. lra.
Qed.

(** The slider takes c|Δ − (z' − z)| ≥ w·Δ − w·(z' − z). *)
Lemma slider_pays d z z' S S' w :
  norm n w <= c -> S' - S + w · d - w · z' + w · z <= rubbed n c d z z' S S'.
Proof.
  intros H. unfold rubbed. pose proof (dot_at_most n w (d - (z' - z))%V c H). expand. lra.
Qed.

(** A + σ·e − w·z + S is at most what has flowed in, the loan, and what the spring held at first. *)
Theorem dual_ledger_with_presliding past A s w :
  booked past A s w ->
  forall e z S E, path past e z S E -> A + s · e - w · z + S <= loan + S0 + E.
Proof.
  induction 1 as [|past A s w h shown held u w' k B IH W K|past A s w h held w' k B IH W K
                  |past A s w h h_longest shown held _ IHseen _ IHdropped
                  |past A A' s w _ IH L|past A s w s' w' B IH W|past A s w W K];
    intros e z S E P.
  - inversion P; subst. expand. lra.
  - inversion P as [|past' e0 y R0 E0 h' shown' held' e' z' S' E' P0 X D L| | |]; subst.
    specialize (IH e0 y R0 E0 P0). specialize (K (shown + e - e0)%V).
    pose proof (charge_covers n q (s + held - u)%V e0 (path_in_box _ _ _ _ _ P0)).
    pose proof (slider_pays (shown + e - e0)%V y z R0 S w' W).
    pose proof (change_of_friction y w w' (proj1 (path_deflected _ _ _ _ _ P0))).
    expand. lra.
  - inversion P as [| |past' e0 y R0 E0 h' held' d e' z' S' E' P0 X D L| |]; subst.
    specialize (IH e0 y R0 E0 P0). specialize (K d).
    pose proof (charge_covers n q s e0 (path_in_box _ _ _ _ _ P0)).
    pose proof (slider_pays d y z R0 S w' W).
    pose proof (change_of_friction y w w' (proj1 (path_deflected _ _ _ _ _ P0))).
    expand. lra.
  - inversion P; subst; auto.
  - specialize (IH e z S E P). lra.
  - specialize (IH e z S E P).
    pose proof (charge_suffices n q (s' - s)%V e (path_in_box _ _ _ _ _ P)).
    pose proof (change_of_friction z w w' (proj1 (path_deflected _ _ _ _ _ P))).
    expand. lra.
  - auto.
Qed.

(** What a deflected spring holds is worth p|w|²/(2c) less than w·z at most. *)
Lemma spring_holds z S w :
  deflected n c p M z S -> norm n w <= c -> - (p * (norm n w * norm n w) / (2 * c)) <= S - w · z.
Proof.
  intros [Z [H [L _]]] W. pose proof (cauchy_schwarz n w z). pose proof p_not_negative.
  pose proof (norm_not_negative n w) as Pw. pose proof (norm_not_negative n z) as Pz.
  rewrite <- (norm_square n z) in H.
  set (a := norm n w) in *. set (r := norm n z) in *.
  destruct (Req_dec c 0) as [C0|C0]; [|destruct (Req_dec p 0) as [P0|P0]].
  - assert (a = 0) as A0 by lra. rewrite A0 in *. unfold Rdiv. lra.
  - assert (r = 0) as R0 by lra. rewrite R0 in *. rewrite P0. unfold Rdiv. lra.
  - assert (c * (r * r) / (2 * p) <= S).
    { apply Rmult_le_reg_l with (2 * p); [lra|].
      replace (2 * p * (c * (r * r) / (2 * p))) with (c * (r * r)) by (field; lra). lra. }
    assert (a * r <= p * (a * a) / (2 * c) + c * (r * r) / (2 * p)); [|lra].
    apply Rminus_le.
    replace (a * r - (p * (a * a) / (2 * c) + c * (r * r) / (2 * p)))
      with (- ((p * a - c * r) * (p * a - c * r)) / (2 * c * p)) by (field; lra).
    assert (0 < / (2 * c * p)) by (apply Rinv_0_lt_compat; nra).
    pose proof (Rle_0_sqr (p * a - c * r)) as Q; unfold Rsqr in Q. unfold Rdiv. nra.
Qed.

(** What is at most loan + S₀ + E on every path that looks like this. *)
Definition sure (past : list event) (energy : R) : Prop :=
  forall e z S E, path past e z S E -> energy <= loan + S0 + E.

(** E ≥ value − loan − S₀, at every tick. *)
Theorem value_is_sure past A s w :
  booked past A s w -> sure past (value A s w).
Proof.
  intros B e z S E P. pose proof (dual_ledger_with_presliding past A s w B e z S E P).
  pose proof (charge_covers n q s e (path_in_box _ _ _ _ _ P)).
  pose proof (spring_holds z S w (path_deflected _ _ _ _ _ P) (booked_within_friction _ _ _ _ B)).
  unfold value. lra.
Qed.

(** Several ledgers of the same history, each with its own u and w (a bundle; one that credits friction
    and one that does not): the larger of two sure values is sure. *)
Theorem larger_of_two past one other : sure past one -> sure past other -> sure past (Rmax one other).
Proof. intros S1 S2 e z S E P. apply Rmax_lub; eauto. Qed.

(** ** The rules of the code *)

(** A tick: u is the friction's alone, |u| ≤ c, and the damper is credited elsewhere, or not. *)
Theorem good_sample past A s w h shown held u :
  (forall d, 0 <= h d) -> booked past A s w -> norm n u <= c ->
  booked (seen h shown held :: past)
    (A + (u - held)%V · shown - charge n q (s + held - u)%V - p * norm n (u - w)%V)
    (u - held)%V u.
Proof.
  intros H B U.
  apply booked_lower with (A + (u - held)%V · shown - 0 - charge n q (s + held - u)%V
                           - p * norm n (u - w)%V); [|lra].
  apply booked_seen; [assumption|assumption|]. intros d. specialize (H d). expand. lra.
Qed.

(** A lost sample: A ← A − ½ Σ qᵢ|σᵢ| − h*(f − û) − p|û − w|, σ ← 0, w ← û; û is any, |û| ≤ c, and f
    brought into that ball is the one that makes h*(f − û) the [worst_outflow] of the policy. *)
Theorem lost_sample past A s w h held clamped k :
  booked past A s w -> norm n clamped <= c -> conjugate_at_most n h (held - clamped)%V k ->
  booked (unseen h held :: past)
    (A - charge n q s - k - p * norm n (clamped - w)%V) zero clamped.
Proof. intros. now apply booked_unseen. Qed.

(** A late tick: the friction's share goes to zero, because the spring may have gone back after the force
    was dropped. To let a share w go costs p|w|; the p|w|²/(2c) of the sure ledger is not enough.

        A ← min { A' − ½ Σ qᵢ|uᵢ − fᵢ| − p|u|,  A − ½ Σ qᵢ|σᵢ| − h*(f − û) − p|û − w| − p|û| },
        σ ← 0, w ← 0, with A' of a good sample. *)
Theorem late_tick past A s w h h_longest shown held u clamped k A' :
  (forall d, 0 <= h d) -> booked past A s w ->
  norm n u <= c -> norm n clamped <= c -> conjugate_at_most n h_longest (held - clamped)%V k ->
  A' = A + (u - held)%V · shown - charge n q (s + held - u)%V - p * norm n (u - w)%V ->
  booked (late h h_longest shown held :: past)
    (Rmin (A' - charge n q (u - held)%V - p * norm n u)
          (A - charge n q s - k - p * norm n (clamped - w)%V - p * norm n clamped))
    zero zero.
Proof.
  intros H B U C L E. assert (Z : norm n zero <= c) by (rewrite norm_zero; lra).
  apply booked_late.
  - apply booked_lower with (A' - charge n q (zero - (u - held))%V - p * norm n (zero - u)%V).
    + apply booked_turn; [|assumption]. rewrite E. now apply good_sample.
    + rewrite charge_opposite, norm_opposite. apply Rmin_l.
  - apply booked_lower with (A - charge n q s - k - p * norm n (clamped - w)%V
                             - charge n q zero - 0 - p * norm n (zero - clamped)%V).
    + apply booked_unseen; [now apply booked_unseen|assumption|]. intros d. expand. lra.
    + rewrite charge_zero, norm_opposite.
      eapply Rle_trans; [apply Rmin_r|]. lra.
Qed.

(** ** The ledger that does not choose u *)

(** A ledger for each u of a finite set, |u| ≤ c, and all of them kept; ‖s‖ = ½ Σ qᵢ|sᵢ|, σ = u − f_last:

        A'(u) = max over w of { A(w) − ‖w − f_last + f − u‖ − p|u − w| } + (u − f)·Δx̂
        value = max over u of { A(u) − ‖u − f‖ − p|u|²/(2c) },        start A(u) = loan − p|u| − ‖u‖

    That five values of one axis come close to the least energy is measured, not proved here; that every set
    of them is sure is. *)

(** The largest of g over a list that begins with [first]. *)
Fixpoint largest (g : vec -> R) (first : vec) (rest : list vec) : R :=
  match rest with
  | [] => g first
  | next :: others => Rmax (g first) (largest g next others)
  end.

Lemma largest_is_one_of_them g first rest : exists w, In w (first :: rest) /\ largest g first rest = g w.
Proof.
  revert first. induction rest as [|next others IH]; intros first; simpl.
  - exists first. auto.
  - destruct (IH next) as [w [I E]]. unfold Rmax. destruct (Rle_dec _ _).
    + exists w. split; [right|]; assumption.
    + exists first. auto.
Qed.

Section retrospective.
Variables (one : vec) (others : list vec).
Hypothesis set_within_friction : forall u, In u (one :: others) -> norm n u <= c.

Inductive retrospective : list event -> vec -> (vec -> R) -> Prop :=
| retrospective_start :
    retrospective [] zero (fun u => loan - p * norm n u - charge n q u)
| retrospective_seen past last A h shown held :
    retrospective past last A -> (forall d, 0 <= h d) ->
    retrospective (seen h shown held :: past) held
      (fun u =>
         largest (fun w => A w - charge n q (w - last + held - u)%V - p * norm n (u - w)%V) one others
         + (u - held)%V · shown)
| retrospective_unseen past last A h held clamped k :
    retrospective past last A -> norm n clamped <= c -> conjugate_at_most n h (held - clamped)%V k ->
    retrospective (unseen h held :: past) zero
      (fun u =>
         largest (fun w => A w - charge n q (w - last)%V - p * norm n (clamped - w)%V) one others
         - k - charge n q u - p * norm n (u - clamped)%V)
| retrospective_late past h h_longest shown held last A A' :
    retrospective (seen h shown held :: past) last A ->
    retrospective (force_free :: unseen h_longest held :: past) zero A' ->
    retrospective (late h h_longest shown held :: past) zero
      (fun u =>
         Rmin (largest (fun w => A w - charge n q (w - last)%V - p * norm n (u - w)%V) one others
               - charge n q u)
              (A' u)).

(** Each value of the set is a dual ledger that could have been booked. *)
Theorem retrospective_is_booked past last A :
  retrospective past last A ->
  forall u, In u (one :: others) -> booked past (A u) (u - last)%V u.
Proof.
  induction 1 as [|past last A h shown held _ IH H|past last A h held clamped k _ IH C K
                  |past h h_longest shown held last A A' _ IH _ IH']; intros u I;
    pose proof (set_within_friction u I) as U.
  - apply booked_lower with (loan - charge n q (u - zero - zero)%V - p * norm n (u - zero)%V).
    + apply booked_turn; [apply booked_start|assumption].
    + rewrite norm_sub_zero.
      rewrite !charge_sub_zero. lra.
  - destruct (largest_is_one_of_them
                (fun w => A w - charge n q (w - last + held - u)%V - p * norm n (u - w)%V)
                one others) as [w [J ->]].
    eapply booked_lower; [exact (good_sample past (A w) _ w h shown held u H (IH w J) U)|lra].
  - destruct (largest_is_one_of_them
                (fun w => A w - charge n q (w - last)%V - p * norm n (clamped - w)%V)
                one others) as [w [J ->]].
    eapply booked_lower.
    + apply booked_turn with (s' := (u - zero)%V) (w' := u); [|assumption].
      exact (booked_unseen past (A w) _ w h held clamped k (IH w J) C K).
    + rewrite !charge_sub_zero. lra.
  - apply booked_late.
    + destruct (largest_is_one_of_them
                  (fun w => A w - charge n q (w - last)%V - p * norm n (u - w)%V)
                  one others) as [w [J E]].
      eapply booked_lower.
      * apply booked_turn with (s' := (u - zero)%V) (w' := u); [|assumption].
        apply booked_turn with (s' := zero) (w' := u); [|assumption]. exact (IH w J).
      * eapply Rle_trans; [apply Rmin_l|]. rewrite E, charge_opposite.
        rewrite !charge_sub_zero, norm_no_difference. lra.
    + eapply booked_lower; [exact (IH' u I)|apply Rmin_r].
Qed.

Theorem retrospective_value_is_sure past last A :
  retrospective past last A -> sure past (largest (fun u => value (A u) (u - last)%V u) one others).
Proof.
  intros H e z S E P.
  destruct (largest_is_one_of_them (fun u => value (A u) (u - last)%V u) one others) as [u [I ->]].
  exact (value_is_sure past _ _ _ (retrospective_is_booked past last A H u I) e z S E P).
Qed.

End retrospective.

(** ** The closed loop *)

Variable worst : vec -> R.  (** W(f), the [worst_outflow] of damper and friction together [J] *)
Hypothesis worst_not_negative : forall f, 0 <= worst f.
Hypothesis no_force_costs_nothing : worst zero = 0.

(** W(f) may be counted on: friction holds a part w of f, |w| ≤ c, and the damper pays for the rest. *)
Definition covered (h : vec -> R) (f : vec) : Prop :=
  exists w, norm n w <= c /\ conjugate_at_most n h (f - w)%V (worst f).

(** A command is a force, or none: the bound answers a debt with none. *)
Definition command := option vec.
Definition force_of (answer : command) : vec :=
  match answer with
  | Some f => f
  | None => zero
  end.

(** What a command costs at most: W(f), and 2cp of friction that was counted on and is not given while the
    spring turns round. *)
Definition cost (answer : command) : R :=
  match answer with
  | Some f => worst f + 2 * c * p
  | None => 0
  end.
Fixpoint total_cost (pending : list command) : R :=
  match pending with
  | [] => 0
  | one :: rest => cost one + total_cost rest
  end.

Notation promised pending := (promised worst (map force_of pending)).

(** The closed loop, k ticks late, the oldest command first. A force is granted only where what is sure
    covers what is on its way and the new one; otherwise there is none, not even what friction would
    hold. What is held may cost less than what was commanded. *)
Inductive loop (k : nat) : list event -> list command -> Prop :=
| loop_start : loop k [] (repeat None k)
| loop_tick past pending (answer oldest : command) rest tick :
    loop k past pending ->
    answer = None \/
      (exists energy, sure past energy /\ worst (force_of answer) <= energy - promised pending) ->
    pending ++ [answer] = oldest :: rest ->
    match oldest with
    | Some f => worst (held_in tick) <= worst f
    | None => held_in tick = zero
    end ->
    (forall d, 0 <= loss_in tick d) -> covered (loss_in tick) (held_in tick) ->
    loop k (tick :: past) rest.

Lemma total_cost_of_a_new_one pending (answer : command) :
  total_cost (pending ++ [answer]) = total_cost pending + cost answer.
Proof. induction pending as [|one rest IH]; simpl; [lra | rewrite IH; lra]. Qed.

Lemma total_cost_at_rest k : total_cost (repeat None k) = 0.
Proof. induction k as [|k IH]; simpl; [reflexivity | rewrite IH; lra]. Qed.

Lemma friction_energy : 0 <= c * p.
Proof. pose proof p_not_negative. nra. Qed.

Lemma total_cost_at_most pending :
  total_cost pending <= promised pending + 2 * c * p * INR (length pending).
Proof.
  pose proof friction_energy.
  induction pending as [|one rest IH]; [simpl; lra|].
  change (length (one :: rest)) with (Datatypes.S (length rest)). rewrite S_INR.
  destruct one as [f|]; simpl; [|rewrite no_force_costs_nothing]; lra.
Qed.

Lemma total_cost_not_negative pending : 0 <= total_cost pending.
Proof.
  pose proof friction_energy. induction pending as [|[f|] rest IH]; simpl; try lra.
  pose proof (worst_not_negative f). lra.
Qed.

Lemma pending_length k past pending : loop k past pending -> length pending = k.
Proof.
  induction 1 as [|past pending answer oldest rest tick _ IH _ Q _ _ _].
  - apply repeat_length.
  - pose proof (f_equal (@length command) Q) as L. rewrite app_length in L. simpl in L. lia.
Qed.

(** A motion takes at most the cost of its force from E − S, which is what is lost for good. *)
Lemma cost_of_motion h f d z z' S S' :
  covered h f -> norm n z <= p -> norm n z' <= p ->
  - (worst f + 2 * c * p) <= h d + rubbed n c d z z' S S' - (S' - S) - f · d.
Proof.
  intros [w [W K]] Z Z'. specialize (K d).
  pose proof (slider_pays d z z' S S' w W).
  pose proof (dot_at_most n w z' c W). pose proof (dot_at_least n w z c W). expand. nra.
Qed.

Lemma no_cost_without_force h d z z' S S' :
  0 <= h d -> 0 <= h d + rubbed n c d z z' S S' - (S' - S) - zero · d.
Proof.
  intros H. unfold rubbed. rewrite dot_zero_l.
  pose proof (norm_not_negative n (d - (z' - z))%V). nra.
Qed.

Lemma outflow tick past oldest e' z' S' E' :
  watchdog ->
  match oldest with
  | Some f => worst (held_in tick) <= worst f
  | None => held_in tick = zero
  end ->
  (forall d, 0 <= loss_in tick d) -> covered (loss_in tick) (held_in tick) ->
  path (tick :: past) e' z' S' E' ->
  exists e z S E, path past e z S E /\ E - S - cost oldest <= E' - S'.
Proof.
  intros W O H C P.
  assert (M1 : forall d z z1 S S1, norm n z <= p -> norm n z1 <= p ->
            - cost oldest <= loss_in tick d + rubbed n c d z z1 S S1 - (S1 - S) - held_in tick · d).
  { intros d z z1 S S1 Z Z1. destruct oldest as [f|]; simpl in *.
    - pose proof (cost_of_motion (loss_in tick) (held_in tick) d z z1 S S1 C Z Z1). lra.
    - rewrite O. pose proof (no_cost_without_force (loss_in tick) d z z1 S S1 (H d)). lra. }
  destruct tick as [h shown held|h held|h h_longest shown held]; simpl in *.
  - inversion P as [|past' e z S E h1 shown' held' e1 z1 S1 E1 P0 X D L| | |]; subst.
    exists e, z, S, E. split; [assumption|].
    specialize (M1 (shown + e' - e)%V z z' S S' (proj1 (path_deflected _ _ _ _ _ P0)) (proj1 D)). lra.
  - inversion P as [| |past' e z S E h1 held' d e1 z1 S1 E1 P0 X D L| |]; subst.
    exists e, z, S, E. split; [assumption|].
    specialize (M1 d z z' S S' (proj1 (path_deflected _ _ _ _ _ P0)) (proj1 D)). lra.
  - inversion P as [| | |past' h1 h2 shown' held' e1 z1 S1 E1 N P0
                    |past' h1 h2 shown' held' e1 z1 S1 E1 P0]; subst; [contradiction|].
    inversion P0 as [| |past' e2 z2 S2 E2 h1 held' d e1 z1 S1 E1 P1 X D L| |]; subst.
    inversion P1 as [| |past' e z S E h1 held' d1 e1 z1 S1 E1 P2 X1 D1 L1| |]; subst.
    exists e, z, S, E. split; [assumption|].
    specialize (M1 d1 z z2 S S2 (proj1 (path_deflected _ _ _ _ _ P2)) (proj1 D1)).
    pose proof (no_cost_without_force (fun _ => 0) d z2 z' S2 S' (Rle_refl 0)). lra.
Qed.

(** The promise, with what is on its way still to be paid. *)
Lemma energy_covers_the_costs k past pending :
  watchdog -> - (M + 2 * c * p * INR (k + 1)) <= loan ->
  loop k past pending ->
  forall e z S E, path past e z S E ->
  total_cost pending - S0 - M - 2 * c * p * INR (k + 1) <= loan + E - S.
Proof.
  intros W R. induction 1 as [|past pending answer oldest rest tick Q IH F X O H C];
    intros e' z' S' E' P.
  - inversion P; subst. rewrite total_cost_at_rest. lra.
  - destruct (outflow tick past oldest e' z' S' E' W O H C P) as [e [z [S [E [P0 L]]]]].
    specialize (IH e z S E P0).
    pose proof (total_cost_of_a_new_one pending answer) as N. rewrite X in N. simpl in N.
    destruct answer as [f|]; simpl in *; [|lra].
    destruct F as [F|[energy [B F]]]; [discriminate|]. specialize (B e z S E P0).
    pose proof (total_cost_at_most pending) as T. rewrite (pending_length _ _ _ Q) in T.
    destruct (path_deflected _ _ _ _ _ P0) as [_ [_ [_ SM]]].
    rewrite plus_INR in *. simpl (INR 1) in *. lra.
Qed.

(** E ≥ −loan − S₀ − M − 2(k + 1)cp at every tick. *)
Theorem passive_port k past pending :
  watchdog -> - (M + 2 * c * p * INR (k + 1)) <= loan ->
  loop k past pending ->
  forall e z S E, path past e z S E -> - loan - S0 - M - 2 * c * p * INR (k + 1) <= E.
Proof.
  intros W R L e z S E P. pose proof (energy_covers_the_costs k past pending W R L e z S E P).
  pose proof (total_cost_not_negative pending).
  destruct (path_deflected _ _ _ _ _ P) as [_ [_ [SP _]]]. lra.
Qed.

(** A ledger that starts at −M − 2(k + 1)cp: nothing is left but what the spring held at the start. *)
Theorem passive_port_with_reserve k past pending :
  watchdog -> loan = - (M + 2 * c * p * INR (k + 1)) ->
  loop k past pending -> forall e z S E, path past e z S E -> - S0 <= E.
Proof.
  intros W R L e z S E P.
  pose proof (passive_port k past pending W ltac:(lra) L e z S E P). lra.
Qed.

(** A ledger that started there may come back to its start at any time, σ ← 0 and w ← 0: its debt is never
    deeper than the reserve. *)
Theorem reserve_is_sure k past pending :
  watchdog -> loan = - (M + 2 * c * p * INR (k + 1)) ->
  loop k past pending -> booked past (loan + total_cost pending) zero zero.
Proof.
  intros W R L. apply booked_known; [rewrite norm_zero; lra|]. intros e z S E P. expand.
  pose proof (energy_covers_the_costs k past pending W ltac:(lra) L e z S E P). lra.
Qed.
End presliding.

(** ** Which frictions these are *)

(** One slider behind a spring c/p: S = ½ (c/p)|z|² ≤ ½cp. *)
Theorem one_slider n c p z :
  0 < c -> 0 < p -> norm n z <= p -> deflected n c p (c * p / 2) z (c / (2 * p) * dot n z z).
Proof.
  intros Hc Hp H. pose proof (norm_not_negative n z). pose proof (dot_self n z).
  assert (0 < / (2 * p)) by (apply Rinv_0_lt_compat; lra).
  split; [assumption|]. split; [right; field; lra|]. split.
  - unfold Rdiv. apply Rmult_le_pos; [nra|assumption].
  - rewrite <- norm_square. replace (c * p / 2) with (c / (2 * p) * (p * p)) by (field; lra).
    apply Rmult_le_compat_l; [unfold Rdiv; nra | nra].
Qed.

(** A spring that is stiffer, or deflected farther, than that of a slider holds more than ½cp: k = c/z_ba of
    the elasto-plastic model with |z| ≤ p, p > z_ba, or k = c_s/p of a slider that is released at c_s > c
    and slides at c. Its M is ½kp². *)
Theorem stiffer_spring n c p k z :
  0 <= c <= k * p -> norm n z <= p -> deflected n c p (k * (p * p) / 2) z (k / 2 * dot n z z).
Proof.
  intros H Z. pose proof (norm_not_negative n z) as N. rewrite <- (norm_square n z).
  set (r := norm n z) in *. destruct (Req_dec p 0) as [P|P].
  - assert (r = 0) as R0 by lra. unfold deflected. rewrite <- (norm_square n z). fold r.
    rewrite R0, P. lra.
  - assert (0 <= k) by (apply Rmult_le_reg_r with p; lra).
    unfold deflected. rewrite <- (norm_square n z). fold r. assert (0 <= r * r <= p * p) by nra.
    split; [assumption|]. split; [|split]; nra.
Qed.

(** To state 2M/c for p is as good: then M = ½cp again. *)
Theorem larger_presliding n c p p' M z S :
  p <= p' -> deflected n c p M z S -> deflected n c p' M z S.
Proof. intros H [Z [D [L U]]]. repeat split; try assumption; nra. Qed.

(** Two frictions side by side are one, with c = c₁ + c₂, p = (c₁p₁ + c₂p₂)/c, z the mean of z₁ and z₂ and
    S their sum; and so are many (Maxwell-slip). With Mᵢ = ½cᵢpᵢ it has M = ½cp. *)
Section side_by_side.
Variable n : nat.
Variables c1 p1 M1 c2 p2 M2 : R.
Hypothesis first : 0 < c1.
Hypothesis second : 0 < c2.
Let c := c1 + c2.
Let p := (c1 * p1 + c2 * p2) / c.
Let mean (z1 z2 : vec) : vec := (c1 / c * z1 + c2 / c * z2)%V.

Theorem side_by_side_deflected z1 S1 z2 S2 :
  0 <= p1 -> 0 <= p2 ->
  deflected n c1 p1 M1 z1 S1 -> deflected n c2 p2 M2 z2 S2 ->
  deflected n c p (M1 + M2) (mean z1 z2) (S1 + S2).
Proof.
  intros P1 P2 [Z1 [H1 [L1 U1]]] [Z2 [H2 [L2 U2]]].
  assert (C : 0 < c) by (unfold c; lra).
  assert (I : 0 < / c) by (now apply Rinv_0_lt_compat).
  assert (Q1 : 0 <= c1 / c) by (unfold Rdiv; nra).
  assert (Q2 : 0 <= c2 / c) by (unfold Rdiv; nra).
  split; [|split; [|lra]].
  - pose proof (norm_triangle n (c1 / c * z1)%V (c2 / c * z2)%V) as T.
    rewrite !norm_scale in T by assumption.
    replace p with (c1 / c * p1 + c2 / c * p2) by (unfold p; field; lra). unfold mean. nra.
  - (* (z₁·z₂)² ≤ |z₁|²|z₂|² makes the mixed term a geometric mean. *)
    pose proof (dot_square n z1 z2) as G.
    pose proof (dot_self n z1) as D1. pose proof (dot_self n z2) as D2.
    set (g := dot n z1 z2) in *. set (d1 := dot n z1 z1) in *. set (d2 := dot n z2 z2) in *.
    assert (X : c1 * c2 * g <= c1 * p1 * S2 + c2 * p2 * S1).
    { assert (0 <= c1 * p1 * S2) by (repeat apply Rmult_le_pos; lra).
      assert (0 <= c2 * p2 * S1) by (repeat apply Rmult_le_pos; lra).
      assert (0 < c1 * c2) as CC by (now apply Rmult_lt_0_compat).
      apply Rsqr_incr_0_var; [unfold Rsqr|lra].
      apply Rle_trans with ((c1 * d1) * (c2 * d2) * (c1 * c2)).
      { replace (c1 * c2 * g * (c1 * c2 * g)) with (c1 * c2 * (c1 * c2) * (g * g)) by ring.
        replace (c1 * d1 * (c2 * d2) * (c1 * c2)) with (c1 * c2 * (c1 * c2) * (d1 * d2)) by ring.
        apply Rmult_le_compat_l; [apply Rmult_le_pos; lra | assumption]. }
      apply Rle_trans with ((2 * p1 * S1) * (2 * p2 * S2) * (c1 * c2)).
      - apply Rmult_le_compat_r; [lra|].
        apply Rmult_le_compat; try assumption; apply Rmult_le_pos; lra.
      - pose proof (Rle_0_sqr (c1 * p1 * S2 - c2 * p2 * S1)) as N; unfold Rsqr in N. lra. }
    replace (c * dot n (mean z1 z2) (mean z1 z2))
      with (/ c * (c1 * (c1 * d1) + 2 * (c1 * c2 * g) + c2 * (c2 * d2))).
    + replace (2 * p * (S1 + S2)) with (/ c * (2 * (c1 * p1 + c2 * p2) * (S1 + S2)))
        by (unfold p; field; lra).
      apply Rmult_le_compat_l; [lra|].
      assert (c1 * (c1 * d1) <= c1 * (2 * p1 * S1)) by (apply Rmult_le_compat_l; lra).
      assert (c2 * (c2 * d2) <= c2 * (2 * p2 * S2)) by (apply Rmult_le_compat_l; lra). lra.
    + unfold mean. expand. rewrite (dot_sym n z2 z1). fold g d1 d2. field; lra.
Qed.

Theorem side_by_side_rubbed d z1 S1 z2 S2 z1' S1' z2' S2' :
  rubbed n c d (mean z1 z2) (mean z1' z2') (S1 + S2) (S1' + S2') <=
  rubbed n c1 d z1 z1' S1 S1' + rubbed n c2 d z2 z2' S2 S2'.
Proof.
  unfold rubbed. assert (C : 0 < c) by (unfold c; lra).
  assert (I : 0 < / c) by (now apply Rinv_0_lt_compat).
  assert (Q1 : 0 <= c1 / c) by (unfold Rdiv; nra).
  assert (Q2 : 0 <= c2 / c) by (unfold Rdiv; nra).
  pose proof (norm_triangle n (c1 / c * (d - (z1' - z1)))%V (c2 / c * (d - (z2' - z2)))%V) as T.
  rewrite !norm_scale in T by assumption.
  replace (norm n (d - (mean z1' z2' - mean z1 z2))%V)
    with (norm n (c1 / c * (d - (z1' - z1)) + c2 / c * (d - (z2' - z2)))%V).
  - apply Rmult_le_compat_l with (r := c) in T; [|lra].
    replace (c * (c1 / c * norm n (d - (z1' - z1))%V + c2 / c * norm n (d - (z2' - z2))%V))
      with (c1 * norm n (d - (z1' - z1))%V + c2 * norm n (d - (z2' - z2))%V) in T by (field; lra).
    lra.
  - unfold norm. f_equal. apply sum_ext. intros i _. unfold mean, add, sub, scale.
    replace (c1 / c) with (1 - c2 / c) by (unfold c; field; unfold c in C; lra). ring.
Qed.
End side_by_side.
