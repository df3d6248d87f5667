(* SPDX-License-Identifier: BSD-3-Clause *)
(** Vectors of any dimension, and what a box of errors can do to them.

    A vector is a function from the number of an axis to its component; only the axes below [n] count.
    Everything the other files need of linear algebra is here: the inner product, its norm,
    Cauchy-Schwarz, and the charge ½ Σ qᵢ|sᵢ| of docs/design/mathematics.md § 3. *)

From Coq Require Import Reals Lra Lia.
Open Scope R_scope.

Definition vec := nat -> R.
Declare Scope vec_scope.
Bind Scope vec_scope with vec.
Delimit Scope vec_scope with V.

Definition zero : vec := fun _ => 0.
Definition add (u v : vec) : vec := fun i => u i + v i.
Definition sub (u v : vec) : vec := fun i => u i - v i.
Definition scale (a : R) (v : vec) : vec := fun i => a * v i.
Infix "+" := add : vec_scope.
Infix "-" := sub : vec_scope.
Infix "*" := scale : vec_scope.

(** ** Finite sums *)

Fixpoint sum (n : nat) (a : nat -> R) : R :=
  match n with
  | O => 0
  | S m => sum m a + a m
  end.

Lemma sum_ext n a b : (forall i, (i < n)%nat -> a i = b i) -> sum n a = sum n b.
Proof.
  induction n as [|n IH]; simpl; intros H; [reflexivity|].
  rewrite IH, (H n); auto.
Qed.

Lemma sum_le n a b : (forall i, (i < n)%nat -> a i <= b i) -> sum n a <= sum n b.
Proof.
  induction n as [|n IH]; simpl; intros H; [lra|].
  apply Rplus_le_compat; auto.
Qed.

Lemma sum_add n a b : sum n (fun i => a i + b i) = sum n a + sum n b.
Proof. induction n as [|n IH]; simpl; [lra | rewrite IH; lra]. Qed.

Lemma sum_scale n k a : sum n (fun i => k * a i) = k * sum n a.
Proof. induction n as [|n IH]; simpl; [lra | rewrite IH; lra]. Qed.

Lemma sum_zero n : sum n (fun _ => 0) = 0.
Proof. induction n as [|n IH]; simpl; lra. Qed.

Lemma sum_not_negative n a : (forall i, (i < n)%nat -> 0 <= a i) -> 0 <= sum n a.
Proof. intros H. rewrite <- (sum_zero n). apply sum_le; auto. Qed.

(** ** The inner product *)

Section inner_product.
Variable n : nat.

Definition dot (u v : vec) : R := sum n (fun i => u i * v i).
Notation "u · v" := (dot u v) (at level 40).

Lemma dot_sym u v : u · v = v · u.
Proof. apply sum_ext; intros; lra. Qed.

Lemma dot_add_l u v w : (u + v)%V · w = u · w + v · w.
Proof. unfold dot. rewrite <- sum_add. apply sum_ext; intros; unfold add; lra. Qed.

Lemma dot_scale_l a u w : (a * u)%V · w = a * (u · w).
Proof. unfold dot. rewrite <- sum_scale. apply sum_ext; intros; unfold scale; lra. Qed.

Lemma dot_sub_l u v w : (u - v)%V · w = u · w - v · w.
Proof.
  replace (u · w - v · w) with (u · w + (-1) * (v · w)) by lra.
  rewrite <- dot_scale_l, <- dot_add_l. apply sum_ext; intros; unfold sub, add, scale; lra.
Qed.

Lemma dot_zero_l w : zero · w = 0.
Proof. unfold dot. rewrite <- (sum_zero n). apply sum_ext; intros; unfold zero; lra. Qed.

Lemma dot_add_r u v w : w · (u + v)%V = w · u + w · v.
Proof. now rewrite dot_sym, dot_add_l, !(dot_sym w). Qed.

Lemma dot_sub_r u v w : w · (u - v)%V = w · u - w · v.
Proof. now rewrite dot_sym, dot_sub_l, !(dot_sym w). Qed.

Lemma dot_scale_r a u w : w · (a * u)%V = a * (w · u).
Proof. now rewrite dot_sym, dot_scale_l, !(dot_sym w). Qed.

Lemma dot_zero_r w : w · zero = 0.
Proof. now rewrite dot_sym, dot_zero_l. Qed.

Lemma dot_self u : 0 <= u · u.
Proof. apply sum_not_negative; intros; apply Rle_0_sqr. Qed.

(** ** The norm *)

Definition norm (u : vec) : R := sqrt (u · u).

Lemma norm_not_negative u : 0 <= norm u.
Proof. apply sqrt_pos. Qed.

Lemma norm_square u : norm u * norm u = u · u.
Proof. apply sqrt_sqrt, dot_self. Qed.

(** (u·v)² ≤ |u|²|v|²: the square |u − t v|² is nowhere negative, whatever t is. *)
Lemma dot_square u v : (u · v) * (u · v) <= (u · u) * (v · v).
Proof.
  assert (H : forall t, 0 <= u · u - 2 * t * (u · v) + t * t * (v · v)).
  { intros t. pose proof (dot_self (u - t * v)%V) as P.
    rewrite dot_sub_l, !dot_sub_r, !dot_scale_l, !dot_scale_r, (dot_sym v u) in P. lra. }
  destruct (Rle_lt_or_eq_dec 0 (v · v) (dot_self v)) as [P|P].
  - specialize (H ((u · v) / (v · v))).
    replace (u · u - 2 * ((u · v) / (v · v)) * (u · v) +
             (u · v) / (v · v) * ((u · v) / (v · v)) * (v · v))
      with (u · u - (u · v) * (u · v) / (v · v)) in H by (field; lra).
    apply Rmult_le_reg_r with (/ (v · v)); [now apply Rinv_0_lt_compat|].
    replace ((u · u) * (v · v) * / (v · v)) with (u · u) by (field; lra).
    unfold Rdiv in H; lra.
  - rewrite <- P. destruct (Req_dec (u · v) 0) as [Z|Z]; [rewrite Z; lra|].
    specialize (H ((u · u + 1) / (2 * (u · v)))). rewrite <- P in H.
    replace (2 * ((u · u + 1) / (2 * (u · v))) * (u · v)) with (u · u + 1) in H by (field; lra).
    lra.
Qed.

Lemma cauchy_schwarz u v : u · v <= norm u * norm v.
Proof.
  pose proof (norm_not_negative u); pose proof (norm_not_negative v).
  apply Rsqr_incr_0_var; [|now apply Rmult_le_pos].
  unfold Rsqr. pose proof (dot_square u v).
  replace (norm u * norm v * (norm u * norm v))
    with ((norm u * norm u) * (norm v * norm v)) by ring.
  now rewrite !norm_square.
Qed.

(** A vector of norm r at most does at least −r|v| against v. *)
Lemma dot_at_least u v r : norm u <= r -> - (r * norm v) <= u · v.
Proof.
  intros H. pose proof (cauchy_schwarz ((-1) * u)%V v) as P. rewrite dot_scale_l in P.
  replace (norm ((-1) * u)%V) with (norm u) in P
    by (unfold norm; rewrite dot_scale_l, dot_scale_r; f_equal; ring).
  pose proof (norm_not_negative v). nra.
Qed.

Lemma dot_at_most u v r : norm u <= r -> u · v <= r * norm v.
Proof.
  intros H. pose proof (cauchy_schwarz u v). pose proof (norm_not_negative v). nra.
Qed.

Lemma norm_zero : norm zero = 0.
Proof. unfold norm. rewrite dot_zero_l. apply sqrt_0. Qed.

Lemma norm_scale a u : 0 <= a -> norm (a * u)%V = a * norm u.
Proof.
  intros H. unfold norm. rewrite dot_scale_l, dot_scale_r.
  replace (a * (a * (u · u))) with (a * a * (u · u)) by ring.
  rewrite sqrt_mult by (try apply dot_self; nra). now rewrite sqrt_square.
Qed.

Lemma norm_triangle u v : norm (u + v)%V <= norm u + norm v.
Proof.
  pose proof (norm_not_negative u); pose proof (norm_not_negative v).
  apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. rewrite norm_square.
  pose proof (norm_square u); pose proof (norm_square v); pose proof (cauchy_schwarz u v).
  rewrite dot_add_l, !dot_add_r, (dot_sym v u). nra.
Qed.

Lemma norm_difference u v : norm (u - v)%V <= norm u + norm v.
Proof.
  pose proof (norm_triangle u ((-1) * v)%V) as P.
  replace (norm ((-1) * v)%V) with (norm v) in P
    by (unfold norm; rewrite dot_scale_l, dot_scale_r; f_equal; ring).
  replace (norm (u - v)%V) with (norm (u + (-1) * v)%V); [exact P|].
  unfold norm; f_equal; apply sum_ext; intros; unfold add, sub, scale; ring.
Qed.

Lemma norm_opposite u : norm (zero - u)%V = norm u.
Proof. unfold norm; f_equal; apply sum_ext; intros; unfold sub, zero; ring. Qed.

Lemma norm_sub_zero u : norm (u - zero)%V = norm u.
Proof. unfold norm; f_equal; apply sum_ext; intros; unfold sub, zero; ring. Qed.

Lemma norm_no_difference u : norm (u - u)%V = 0.
Proof. rewrite <- norm_zero. unfold norm; f_equal; apply sum_ext; intros; unfold sub, zero; ring. Qed.

(** ** The box of errors *)

Variable q : vec.

(** Each position shown is wrong by half a step at most: |eᵢ| ≤ qᵢ/2. *)
Definition in_box (e : vec) : Prop := forall i, (i < n)%nat -> Rabs (e i) <= q i / 2.

(** ½ Σ qᵢ|sᵢ|, the most that the inner product with an error can take. *)
Definition charge (s : vec) : R := sum n (fun i => q i / 2 * Rabs (s i)).

Lemma charge_covers s e : in_box e -> - charge s <= s · e.
Proof.
  intros H. replace (- charge s) with (sum n (fun i => (-1) * (q i / 2 * Rabs (s i))))
    by (rewrite sum_scale; unfold charge; lra).
  apply sum_le; intros i Hi. specialize (H i Hi).
  pose proof (Rabs_pos (s i)). pose proof (Rle_abs (- (s i * e i))) as P.
  rewrite Rabs_Ropp, Rabs_mult in P. nra.
Qed.

Lemma charge_suffices s e : in_box e -> s · e <= charge s.
Proof.
  intros H. apply sum_le; intros i Hi. specialize (H i Hi).
  pose proof (Rabs_pos (s i)). pose proof (Rle_abs (s i * e i)) as P. rewrite Rabs_mult in P. nra.
Qed.

(** And some error takes all of it, so the charge is the least possible. *)
Lemma charge_is_taken s :
  (forall i, (i < n)%nat -> 0 <= q i) -> exists e, in_box e /\ s · e = - charge s.
Proof.
  intros Q. exists (fun i => if Rle_dec 0 (s i) then - (q i / 2) else q i / 2). split.
  - intros i Hi. specialize (Q i Hi).
    destruct (Rle_dec 0 (s i)); unfold Rabs; destruct (Rcase_abs _); lra.
  - replace (- charge s) with (sum n (fun i => (-1) * (q i / 2 * Rabs (s i))))
      by (rewrite sum_scale; unfold charge; lra).
    apply sum_ext; intros i _.
    destruct (Rle_dec 0 (s i)); unfold Rabs; destruct (Rcase_abs _); lra.
Qed.

Lemma charge_zero : charge zero = 0.
Proof.
  unfold charge. rewrite <- (sum_zero n). apply sum_ext; intros; unfold zero.
  rewrite Rabs_R0; lra.
Qed.

Lemma charge_opposite s : charge (zero - s)%V = charge s.
Proof.
  apply sum_ext; intros i _. unfold sub, zero. now rewrite Rminus_0_l, Rabs_Ropp.
Qed.

Lemma charge_sub_zero s : charge (s - zero)%V = charge s.
Proof. apply sum_ext; intros i _. unfold sub, zero. now rewrite Rminus_0_r. Qed.

Lemma charge_not_negative s : (forall i, (i < n)%nat -> 0 <= q i) -> 0 <= charge s.
Proof.
  intros Q. apply sum_not_negative; intros i Hi. specialize (Q i Hi).
  pose proof (Rabs_pos (s i)). nra.
Qed.
End inner_product.

(** One axis: the norm is the magnitude. *)
Lemma norm_one_axis u : norm 1 u = Rabs (u O).
Proof. unfold norm, dot, sum. rewrite Rplus_0_l. apply sqrt_Rsqr_abs. Qed.

(** Inner products are multiplied out; what is left is linear arithmetic. *)
Ltac expand :=
  repeat rewrite ?dot_add_l, ?dot_add_r, ?dot_sub_l, ?dot_sub_r, ?dot_scale_l, ?dot_scale_r,
    ?dot_zero_l, ?dot_zero_r in *.
