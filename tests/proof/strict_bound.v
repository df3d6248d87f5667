(* SPDX-License-Identifier: BSD-3-Clause *)
(** The strict bound, docs/design/mathematics.md § 2 (a), with the latency and the jitter of § 3.

    W(f) is the worst outflow of a force, T|f|²/(4b) or what lemma L3 says of another damping, with T the
    longest tick. In a loop that is k ticks late the command f(n) is held during [n+k, n+k+1); what is on
    its way counts as spent:

        W(f(n)) ≤ E1(n) − Σ_{j=1..k} W(f(n−j))

    First for the thesis's own ledger, then for every ledger that is nowhere above the energy at the port:
    the energy that has flowed in is never below −loan, whatever the hand and the environment do. *)

From Coq Require Import Reals Lra Lia List.
From passive_haptics Require Import vectors damping dual_ledger.
Import ListNotations.
Open Scope R_scope.

Section strict_bound.
Variable n : nat.
Variable loan : R.
Variable worst : vec -> R.  (** W(f) [J] *)
Hypothesis loan_not_negative : 0 <= loan.
Hypothesis worst_not_negative : forall f, 0 <= worst f.
Hypothesis no_force_costs_nothing : worst zero = 0.
Notation "u · v" := (dot n u v) (at level 40).

(** What the commands that are on their way can still cost [J]; the oldest comes first. *)
Fixpoint promised (pending : list vec) : R :=
  match pending with
  | [] => 0
  | f :: rest => worst f + promised rest
  end.

Lemma promised_of_a_new_one pending f : promised (pending ++ [f]) = promised pending + worst f.
Proof. induction pending as [|g pending IH]; simpl; [lra | rewrite IH; lra]. Qed.

Lemma promised_at_rest k : promised (repeat zero k) = 0.
Proof.
  induction k as [|k IH]; simpl; [reflexivity | rewrite IH, no_force_costs_nothing; lra].
Qed.

Lemma promised_not_negative pending : 0 <= promised pending.
Proof.
  induction pending as [|f pending IH]; simpl; [lra|].
  pose proof (worst_not_negative f). lra.
Qed.

(** ** § 2 (a): the ledger of the thesis, exact positions *)

(** [thesis k pending E1 E]: the loop, k ticks late, has come to the ledger E1 with E [J] flowed in.
    In each tick the bound grants f; the oldest command, or one that costs no more, is [held] while the
    device moves by d; [gain] is what is booked of the damping, ΔxᵀBΔx, and no more than what is lost. *)
Inductive thesis (k : nat) : list vec -> R -> R -> Prop :=
| thesis_start : thesis k (repeat zero k) loan 0
| thesis_tick pending rest E1 E f oldest held d gain lost :
    thesis k pending E1 E ->
    worst f <= Rmax 0 (E1 - promised pending) ->
    pending ++ [f] = oldest :: rest -> worst held <= worst oldest ->
    held · d - worst held <= gain -> gain <= lost ->
    thesis k rest (E1 + gain - held · d) (E + lost - held · d).

(** E1 covers what is on its way at every tick, so it is never negative; and E ≥ E1 − loan. *)
Theorem strict_bound_of_the_thesis k pending E1 E :
  thesis k pending E1 E -> promised pending <= E1 /\ E1 - loan <= E.
Proof.
  induction 1 as [|pending rest E1 E f oldest held d gain lost _ [P L] F Q O G D].
  - rewrite promised_at_rest. lra.
  - pose proof (promised_of_a_new_one pending f) as N. rewrite Q in N. simpl in N.
    pose proof (worst_not_negative f).
    unfold Rmax in F. destruct (Rle_dec 0 (E1 - promised pending)); lra.
Qed.

Corollary thesis_is_passive k pending E1 E : thesis k pending E1 E -> 0 <= E1 /\ - loan <= E.
Proof.
  intros H. destruct (strict_bound_of_the_thesis k pending E1 E H).
  pose proof (promised_not_negative pending). lra.
Qed.

(** ** Any sure ledger *)

Variable q : vec.
Variable watchdog : Prop.
Notation path := (path n q watchdog).

(** The force that a tick held, and the loss that W(f) is counted on. *)
Definition held_in (tick : event) : vec :=
  match tick with
  | seen _ _ held | unseen _ held | late _ _ _ held => held
  end.
Definition loss_in (tick : event) : vec -> R :=
  match tick with
  | seen h _ _ | unseen h _ | late _ h _ _ => h
  end.

(** What has flowed in at least, with the loan, on every path that looks like this. *)
Definition sure (past : list event) (energy : R) : Prop :=
  forall e E, path past e E -> energy <= loan + E.

(** [loop k past pending]: the closed loop has made the history [past], and [pending] is on its way. The
    bound may spend whatever is sure. W covers every tick: none is longer than T, or a watchdog drops
    the force within T. *)
Inductive loop (k : nat) : list event -> list vec -> Prop :=
| loop_start : loop k [] (repeat zero k)
| loop_tick past pending energy f oldest rest tick :
    loop k past pending ->
    sure past energy ->
    worst f <= Rmax 0 (energy - promised pending) ->
    pending ++ [f] = oldest :: rest -> worst (held_in tick) <= worst oldest ->
    conjugate_at_most n (loss_in tick) (held_in tick) (worst (held_in tick)) ->
    loop k (tick :: past) rest.

(** L3: a tick takes out W(f) at most. *)
Lemma outflow tick past e' E' :
  watchdog -> conjugate_at_most n (loss_in tick) (held_in tick) (worst (held_in tick)) ->
  path (tick :: past) e' E' ->
  exists e E, path past e E /\ E - worst (held_in tick) <= E'.
Proof.
  intros W C P.
  destruct tick as [h shown held|h held|h h_longest shown held]; simpl in *.
  - inversion P as [|past' e E h' shown' held' e1 E1 P0 B L| | |]; subst.
    exists e, E. split; [assumption|]. specialize (C (shown + e' - e)%V). lra.
  - inversion P as [| |past' e E h' held' d e1 E1 P0 B L| |]; subst.
    exists e, E. split; [assumption|]. specialize (C d). lra.
  - inversion P as [| | |past' h1 h2 shown' held' e1 E1 N P0|past' h1 h2 shown' held' e1 E1 P0]; subst;
      [contradiction|].
    inversion P0 as [| |past' e2 E2 h' held' d e1 E1 P1 B L| |]; subst.
    inversion P1 as [| |past' e E h' held' d1 e1 E1 P2 B1 L1| |]; subst.
    exists e, E. split; [assumption|]. specialize (C d1). expand. lra.
Qed.

(** The energy always covers what is on its way. The ledger need not be positive for that: a debt of the
    ledger alone grants nothing, and without a force nothing flows out. *)
Theorem energy_covers_the_promises k past pending :
  watchdog -> loop k past pending -> forall e E, path past e E -> promised pending <= loan + E.
Proof.
  intros W. induction 1 as [|past pending energy f oldest rest tick _ IH B F Q O C]; intros e' E' P.
  - inversion P; subst. rewrite promised_at_rest. lra.
  - destruct (outflow tick past e' E' W C P) as [e [E [P0 L]]].
    specialize (IH e E P0). specialize (B e E P0).
    pose proof (promised_of_a_new_one pending f) as N. rewrite Q in N. simpl in N.
    unfold Rmax in F. destruct (Rle_dec 0 (energy - promised pending)); lra.
Qed.

(** The strict bound k ticks late: the port never gives back more than the loan. *)
Theorem passive_port k past pending :
  watchdog -> loop k past pending -> forall e E, path past e E -> - loan <= E.
Proof.
  intros W L e E P. pose proof (energy_covers_the_promises k past pending W L e E P).
  pose proof (promised_not_negative pending). lra.
Qed.

Notation booked := (booked n q loan watchdog).

(** The dual ledger is one that it may spend. *)
Theorem dual_ledger_is_sure past A s : booked past A s -> sure past (value n q A s).
Proof. intros B e E P. exact (value_is_sure n q loan watchdog past A s B e E P). Qed.

(** A debt of a ledger that never granted too much is not one of the port: A ← 0, σ ← 0 is sure at any
    time, and so is A ← what is on its way. (L7 is about a debt of the port.) *)
Theorem empty_ledger_is_sure k past pending :
  watchdog -> loop k past pending -> booked past (promised pending) zero.
Proof.
  intros W L. apply booked_known. intros e E P. expand.
  pose proof (energy_covers_the_promises k past pending W L e E P). lra.
Qed.

(** So a lost sample need not take the ledger below zero, nor one in debt any farther: [written_off]. *)
Theorem lost_sample_down_to_nothing k past rest h held A s worst_case :
  watchdog -> loop k (unseen h held :: past) rest ->
  booked past A s -> conjugate_at_most n h held worst_case ->
  booked (unseen h held :: past)
    (Rmax (Rmin (value n q A s) 0) (value n q A s - worst_case)) zero.
Proof.
  intros W L B C. unfold Rmax. destruct (Rle_dec _ _) as [H|H].
  - now apply lost_sample.
  - apply booked_lower with (promised rest); [exact (empty_ledger_is_sure k _ rest W L)|].
    pose proof (promised_not_negative rest). pose proof (Rmin_r (value n q A s) 0). lra.
Qed.
End strict_bound.

(** ** With the numbers of [damping_and_friction], and of [isotropic_damping] with c = 0 *)

(** The credit of § 3: measured length t ≤ T of a tick in the ledger, the longest T in the bound. *)
Theorem strict_bound_with_jitter n b c T t f d :
  0 < b -> 0 < t <= T ->
  dot n f d - worst_outflow n b c T f <= dissipated n b c t d.
Proof.
  intros Hb Ht. pose proof (worst_tick n b c T f Hb ltac:(lra) d).
  pose proof (shorter_ticks n b c t T d ltac:(lra) Ht). lra.
Qed.

(** T|f|²/(4b) ≤ E1 at every tick: what [thesis] asks of a damper and a friction, and so E ≥ −loan. *)
Theorem strict_bound n b c T loan k pending E1 E :
  0 < b -> 0 < T -> 0 <= c -> 0 <= loan ->
  thesis n loan (worst_outflow n b c T) k pending E1 E -> 0 <= E1 /\ - loan <= E.
Proof.
  intros Hb HT Hc Hl. apply thesis_is_passive; [assumption| |].
  - intros f. now apply worst_outflow_not_negative.
  - unfold worst_outflow, beyond. rewrite norm_zero, Rmax_left by lra. field; lra.
Qed.
