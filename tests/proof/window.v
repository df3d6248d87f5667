(* SPDX-License-Identifier: BSD-3-Clause *)
(** The viscous window: what a damper has surely taken, from positions that are only known to a box.

    In a tick of length t the damper takes Σ bᵢΔᵢ²/t at least, and the true travel is the one shown but
    for the errors of its two ends. Sure is what remains of a travel shortened by qᵢ on each axis: tick by
    tick, or over a window of ticks as a whole (L1 over the window), which alone sees slow motion. The
    ledger books the largest that either has come to since the window began, beside what u earns from the
    rest of the loss; docs/design/mathematics.md § 3.

    A lost sample and a late tick begin a new window: h* has then spent the damper of that tick already,
    and an end of the window that was not seen would be uncertain by more than q. *)

From Coq Require Import Reals Lra Lia List.
From passive_haptics Require Import vectors damping dual_ledger presliding.
Import ListNotations.
Open Scope R_scope.

(** (a + b)²/(s + t) ≤ a²/s + b²/t: one long tick is sure of less than two short ones. *)
Lemma two_travels a b s t : 0 < s -> 0 < t -> (a + b) * (a + b) / (s + t) <= a * a / s + b * b / t.
Proof.
  intros Hs Ht. apply Rminus_le.
  replace ((a + b) * (a + b) / (s + t) - (a * a / s + b * b / t))
    with (- ((a * t - b * s) * (a * t - b * s)) / (s * t * (s + t))) by (field; lra).
  assert (0 < / (s * t * (s + t))) by (apply Rinv_0_lt_compat; repeat apply Rmult_lt_0_compat; lra).
  pose proof (Rle_0_sqr (a * t - b * s)) as P; unfold Rsqr in P. unfold Rdiv. nra.
Qed.

Section window.
Variable n : nat.
Variable q : vec.
Variable b : vec.  (** damping of each axis [N·s/m] *)
Hypothesis damps : forall i, 0 <= b i.

Notation viscous := (dissipated_by_axes n b).

(** The length of a travel shortened by q on each axis; its sign does not matter here. *)
Definition surely_moved (shown : vec) : vec := fun i => Rmax 0 (Rabs (shown i) - q i).

(** What the ledger knows of the window: Δx̂ and the time since it began, the credit of its ticks one by
    one, and how much has been booked. *)
Record window := { travelled : vec; elapsed : R; summed : R; credit : R }.
Definition fresh : window := {| travelled := zero; elapsed := 0; summed := 0; credit := 0 |}.
Definition after (w : window) (shown : vec) (t : R) : window :=
  let travelled := (travelled w + shown)%V in
  let elapsed := elapsed w + t in
  let summed := summed w + viscous t (surely_moved shown) in
  {| travelled := travelled; elapsed := elapsed; summed := summed;
     credit := Rmax (credit w) (Rmax summed (viscous elapsed (surely_moved travelled))) |}.

(** ** What the window is sure of *)

Lemma viscous_not_negative t d : 0 < t -> 0 <= viscous t d.
Proof.
  intros Ht. apply sum_not_negative; intros i _.
  assert (0 < / t) by (now apply Rinv_0_lt_compat). specialize (damps i).
  pose proof (Rle_0_sqr (d i)) as P; unfold Rsqr in P. unfold Rdiv.
  apply Rmult_le_pos; [apply Rmult_le_pos|]; lra.
Qed.

(** Two errors take q at most from a travel. *)
Lemma sure_travel t shown e e' :
  0 < t -> in_box n q e -> in_box n q e' ->
  viscous t (surely_moved shown) <= viscous t (shown + e' - e)%V.
Proof.
  intros Ht B B'. apply sum_le; intros i Hi. specialize (B i Hi). specialize (B' i Hi).
  assert (0 < / t) by (now apply Rinv_0_lt_compat). pose proof (damps i).
  unfold Rdiv. apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; [assumption|].
  apply Rsqr_le_abs_1. unfold surely_moved, add, sub.
  unfold Rmax, Rabs in *. repeat destruct (Rcase_abs _); repeat destruct (Rle_dec _ _); lra.
Qed.

(** L1 over a window: it is sure of no more than its parts. *)
Lemma longer_travel s t d d' :
  0 < s -> 0 < t -> viscous (s + t) (d + d')%V <= viscous s d + viscous t d'.
Proof.
  intros Hs Ht. unfold dissipated_by_axes. rewrite <- sum_add. apply sum_le; intros i _.
  pose proof (two_travels (d i) (d' i) s t Hs Ht) as P. pose proof (damps i). unfold add.
  apply Rmult_le_compat_l with (r := b i) in P; [|assumption]. unfold Rdiv in *. lra.
Qed.

Lemma viscous_ext t d d' : (forall i, (i < n)%nat -> d i = d' i) -> viscous t d = viscous t d'.
Proof. intros H. apply sum_ext; intros i Hi. now rewrite (H i Hi). Qed.

(** The damper has taken at least L since the window began at the error [began]; no more is booked. *)
Definition covered_by (w : window) (began e : vec) (L : R) : Prop :=
  in_box n q began /\ 0 <= L /\ summed w <= L /\ credit w <= L /\
  ((elapsed w = 0 /\ forall i, (i < n)%nat -> travelled w i + e i - began i = 0) \/
   (0 < elapsed w /\ viscous (elapsed w) (travelled w + e - began)%V <= L)).

Lemma fresh_is_covered e : in_box n q e -> covered_by fresh e e 0.
Proof.
  intros B. split; [assumption|]. simpl. repeat split; try lra. left.
  split; [reflexivity|]. intros i _. unfold zero. lra.
Qed.

Lemma after_is_covered w began e L shown t e' :
  covered_by w began e L -> in_box n q e -> in_box n q e' -> 0 < t ->
  covered_by (after w shown t) began e' (L + viscous t (shown + e' - e)%V).
Proof.
  intros [B0 [P0 [Hs [Hb Hw]]]] B B' Ht.
  pose proof (sure_travel t shown e e' Ht B B') as Sure.
  pose proof (viscous_not_negative t (shown + e' - e)%V Ht) as Pos.
  assert (W : 0 < elapsed w + t /\
              viscous (elapsed w + t) (travelled w + shown + e' - began)%V <=
              L + viscous t (shown + e' - e)%V).
  { destruct Hw as [[Z N]|[P V]].
    - rewrite Z, Rplus_0_l. split; [assumption|].
      rewrite (viscous_ext t _ (shown + e' - e)%V); [lra|].
      intros i Hi. specialize (N i Hi). unfold add, sub in *. lra.
    - split; [lra|].
      rewrite (viscous_ext (elapsed w + t) _ ((travelled w + e - began) + (shown + e' - e))%V).
      + pose proof (longer_travel (elapsed w) t (travelled w + e - began)%V (shown + e' - e)%V P Ht). lra.
      + intros i _. unfold add, sub. lra. }
  destruct W as [T V]. pose proof (sure_travel _ (travelled w + shown)%V began e' T B0 B') as Whole.
  split; [assumption|]. simpl. split; [lra|]. split; [lra|]. split.
  - repeat apply Rmax_lub; lra.
  - right. split; [assumption|exact V].
Qed.

(** ** Beside the ledger *)

Variables c p M loan : R.
Variables (z0 : vec) (S0 : R).
Variable watchdog : Prop.
Hypothesis friction : 0 <= c.
Hypothesis start_deflected : deflected n c p M z0 S0.
Notation path := (path n q c p M z0 S0 watchdog).
Notation booked := (booked n q c p M loan z0 S0 watchdog).
Notation sure := (sure n q c p M loan z0 S0 watchdog).

(** [credited past rest w gained]: of the history [past] the window's damper has been set aside; [rest] is the
    same history without it, w the window, and gained [J] all that windows have booked. A lost sample and a
    late tick keep their damper: h* spends it. A window may end at any tick. *)
Inductive credited : list event -> list event -> window -> R -> Prop :=
| credited_start : credited [] [] fresh 0
| credited_seen past rest w gained h t shown held :
    credited past rest w gained -> 0 < t ->
    credited (seen (fun d => h d + viscous t d) shown held :: past) (seen h shown held :: rest)
      (after w shown t) (gained + (credit (after w shown t) - credit w))
| credited_unseen past rest w gained h held :
    credited past rest w gained -> credited (unseen h held :: past) (unseen h held :: rest) fresh gained
| credited_late past rest w gained h h_longest shown held :
    credited past rest w gained ->
    credited (late h h_longest shown held :: past) (late h h_longest shown held :: rest) fresh gained
| credited_new_window past rest w gained : credited past rest w gained -> credited past rest fresh gained.

(** What the damper took, X, covers what was booked; and without X the path is one of the rest. *)
Lemma set_aside past rest w gained :
  credited past rest w gained ->
  forall e z S E, path past e z S E ->
  exists X began L, path rest e z S (E - X) /\ covered_by w began e L /\ gained - credit w + L <= X.
Proof.
  assert (Restart : forall e w began L X gained, in_box n q e -> covered_by w began e L ->
            gained - credit w + L <= X -> covered_by fresh e e 0 /\ gained - credit fresh + 0 <= X).
  { intros e w' began L X gained' B [_ [_ [_ [K _]]]] H. split; [now apply fresh_is_covered|simpl; lra]. }
  induction 1 as [|past rest w gained h t shown held _ IH T|past rest w gained h held _ IH
                  |past rest w gained h h_longest shown held _ IH|past rest w gained _ IH]; intros e z S E P.
  - inversion P; subst. exists 0, e, 0. split; [|split; [now apply fresh_is_covered|simpl; lra]].
    rewrite Rminus_0_r. now apply path_start.
  - inversion P as [|past' e0 y R0 E0 h' shown' held' e' z' S' E' P0 B D H| | |]; subst.
    destruct (IH e0 y R0 E0 P0) as [X [began [L [Q [C K]]]]].
    exists (X + viscous t (shown + e - e0)%V), began, (L + viscous t (shown + e - e0)%V).
    split; [|split; [|lra]].
    + eapply path_seen; [exact Q|assumption|assumption|]. lra.
    + apply after_is_covered; try assumption. exact (path_in_box _ _ _ _ _ _ _ _ _ _ _ _ _ P0).
  - inversion P as [| |past' e0 y R0 E0 h' held' d e' z' S' E' P0 B D H| |]; subst.
    destruct (IH e0 y R0 E0 P0) as [X [began [L [Q [C K]]]]].
    assert (B0 := path_in_box _ _ _ _ _ _ _ _ _ _ _ _ _ P0).
    destruct (Restart e0 w began L X gained B0 C K) as [_ K'].
    exists X, e, 0. split; [|split; [now apply fresh_is_covered|exact K']].
    eapply path_unseen; [exact Q|assumption|assumption|]. instantiate (1 := d). lra.
  - inversion P as [| | |past' h1 h2 shown' held' e' z' S' E' N P0
                    |past' h1 h2 shown' held' e' z' S' E' P0]; subst.
    + inversion P0 as [|past' e0 y R0 E0 h' shown' held' e' z' S' E' P1 B D H| | |]; subst.
      destruct (IH e0 y R0 E0 P1) as [X [began [L [Q [C K]]]]].
      assert (B0 := path_in_box _ _ _ _ _ _ _ _ _ _ _ _ _ P1).
      destruct (Restart e0 w began L X gained B0 C K) as [_ K'].
      exists X, e, 0. split; [|split; [now apply fresh_is_covered|exact K']].
      apply path_held_to_the_end; [assumption|].
      eapply path_seen; [exact Q|assumption|assumption|]. lra.
    + inversion P0 as [| |past' e1 y1 R1 E1 h' held' d' e' z' S' E' P1 B D H| |]; subst.
      inversion P1 as [| |past' e0 y R0 E0 h' held' d e' z' S' E' P2 B1 D1 H1| |]; subst.
      destruct (IH e0 y R0 E0 P2) as [X [began [L [Q [C K]]]]].
      assert (B0 := path_in_box _ _ _ _ _ _ _ _ _ _ _ _ _ P2).
      destruct (Restart e0 w began L X gained B0 C K) as [_ K'].
      exists X, e, 0. split; [|split; [now apply fresh_is_covered|exact K']].
      apply path_dropped. unfold force_free.
      apply path_unseen with (d := d') (e := e1) (z := y1) (S := R1) (E := E1 - X);
        [|assumption|exact D|lra].
      eapply path_unseen with (d := d); [exact Q|assumption|assumption|lra].
  - destruct (IH e z S E P) as [X [began [L [Q [C K]]]]].
    assert (B0 := path_in_box _ _ _ _ _ _ _ _ _ _ _ _ _ P).
    destruct (Restart e w began L X gained B0 C K) as [F K'].
    exists X, e, 0. auto.
Qed.

(** The dual ledger of the rest and the credit of the windows together are sure. *)
Theorem window_beside_the_ledger past rest w gained A s u :
  credited past rest w gained -> booked rest A s u -> sure past (value n q c p A s u + gained).
Proof.
  intros K B e z S E P. destruct (set_aside past rest w gained K e z S E P) as [X [began [L [Q [C H]]]]].
  pose proof (value_is_sure n q c p M loan z0 S0 watchdog friction start_deflected
                rest A s u B e z S (E - X) Q) as V.
  destruct C as [_ [_ [_ [C _]]]]. lra.
Qed.
End window.
