(** Equations of docs/semantics.md that look like laws but are not.
  Each theorem has residuals of that shape, and a step of
    one of them, perhaps after others that both can make, which the other does not have. *)
From Dolphin Require Export Laws.
Set Implicit Arguments.
Unset Strict Implicit.

Section Not_laws.
  Context {L : Names} {C : Code}.

  (** Bisimilar by steps alone, whatever is seen from beside. *)
  Definition alike_steps (r r' : residual) : Prop :=
    exists R : residual -> residual -> Prop, (forall a b, R a b -> R b a) /\
      (forall a b, R a b -> simulates R a b) /\ R r r'.

  Lemma bisimilar_alike r r' : bisimilar r r' -> alike_steps r r'.
  Proof. intros (R & HR & H). exists R. destruct HR. auto. Qed.

  Lemma alike_next r r' : alike_steps r r' -> forall e K S t, goes e K S r t ->
    exists t', goes e K S r' t' /\ agree alike_steps t t'.
  Proof.
    intros (R & Hs & Hr & H) e K S t Ht. destruct (Hr r r' H e K S t Ht) as (t' & T & A). exists t'.
    split; [exact T|]. eapply agree_more; [|exact A]. intros a b Hab. exists R. auto.
  Qed.

  Lemma alike_back r r' : alike_steps r r' -> alike_steps r' r.
  Proof. intros (R & Hs & Hr & H). exists R. auto. Qed.

  (** [t] is a step of [r]; what may answer it is found by computing. *)
  Ltac answer H e K S t T A :=
    let u := fresh "u" in
    destruct (alike_next H (e := e) (K := K) (S := S) (t := t)) as (u & T & A);
    [apply steps_iff_goes; cbn | apply steps_iff_goes in T; cbn in T; destruct u; cbn in A].

  (** [idle 0 >> t = t] *)
  Theorem idle_first_is_no_law (w : world) (S : shared) i n p v : ~ alike_steps (Sequence (Idle i n) (Ready p v))
    (Ready p v).
  Proof.
    intros H. apply alike_back in H.
    answer H (@None event) (alone w) S (By (LStart v p) (start_on v p S) (Next (Running p v)) [Start p v]) T A.
    - auto.
    - contradiction.
  Qed.

  (** After a step that can only be answered in one way. *)
  Ltac sole T A :=
    repeat match type of T with
    | context [vehicle_eq ?v ?v] => destruct (vehicle_eq v v); [|congruence]
    | context [vehicle_eq ?v ?w] => destruct (vehicle_eq v w); [congruence|]
    | context [timer_eq ?i ?i] => destruct (timer_eq i i); [|congruence]
    | context [timer_eq ?i ?j] => destruct (timer_eq i j); [congruence|]
    end; cbn in T;
    repeat (destruct T as [T | T]; [injection T as <- <- <- <- | ]); try contradiction;
    try (destruct A as (? & ? & ?); first [discriminate | contradiction | congruence]).

  Ltac done_by := cbn; repeat match goal with
    | |- context [vehicle_eq ?v ?v] => destruct (vehicle_eq v v); [|congruence]
    | |- context [timer_eq ?i ?i] => destruct (timer_eq i i); [|congruence]
    end; cbn; auto.

  (** [idle 0 | t = t] *)
  Theorem idle_beside_is_no_law (w : world) (S : shared) i n p v : ~ alike_steps (Parallel [Idle i n;
    Ready p v]) (Ready p v).
  Proof.
    intros H. apply alike_back in H.
    answer H (@None event) (alone w) S (By (LStart v p) (start_on v p S) (Next (Running p v)) [Start p v]) T A;
      [done_by|].
    sole T A. destruct A as (_ & _ & H1). clear H.
    answer H1 (Some (Done v)) (alone w) S (By (LDone v p) (without [v] S) Ok []) T1 A1; [done_by|].
    sole T1 A1.
  Qed.

  (** [confirm x | confirm x = confirm x] *)
  Theorem confirm_twice_is_no_law (w : world) (S : shared) i j x at_site : i <> j ->
    ~ alike_steps (Parallel [Confirm i x at_site; Confirm j x at_site]) (Confirm i x at_site).
  Proof.
    intros Hij H. apply alike_back in H.
    answer H (Some (Answered i true)) (alone w) S (By (LAnswered true) S Ok []) T A; [done_by|].
    sole T A.
  Qed.

  (** [action { } >> t = t] *)
  Theorem action_first_is_no_law (w : world) (S : shared) a p v : ~ alike_steps (Sequence (Action a) (Ready p v))
    (Ready p v).
  Proof.
    intros H. apply alike_back in H.
    answer H (@None event) (alone w) S (By (LStart v p) (start_on v p S) (Next (Running p v)) [Start p v]) T A;
      [done_by|].
    unfold coded, breaks in T. destruct (runs a [] _ S); sole T A.
  Qed.

  (** [condition { true } >> t = t] *)
  Theorem condition_first_is_no_law (w : world) (S : shared) g p v : ~ alike_steps (Sequence (Condition g) (Ready p
    v)) (Ready p v).
  Proof.
    intros H. apply alike_back in H.
    answer H (@None event) (alone w) S (By (LStart v p) (start_on v p S) (Next (Running p v)) [Start p v]) T A;
      [done_by|].
    unfold guarded, coded, breaks in T. destruct (runs g [] _ S) as [x s N ds | m ds | m ds | m s N ds |];
      [destruct (truth x) as [[]|] | destruct (is_unknown m) | | |]; sole T A.
  Qed.

  (** [t | t = t] *)
  Theorem twice_is_no_law (w : world) (S : shared) p v v' : v <> v' -> ~ alike_steps (Parallel [Ready p v;
    Ready p v']) (Ready p v).
  Proof.
    intros Hv H.
    answer H (@None event) (alone w) S
      (By (LStart v' p) (start_on v' p S) (Next (Parallel [Ready p v; Running p v'])) [Start p v']) T A; [done_by|].
    sole T A.
  Qed.

  (** [t >> (t' | t'') = (t >> t') | (t >> t'')] *)
  Theorem distribution_is_no_law (w : world) (S : shared) p v v' t t' : v <> v' ->
    ~ alike_steps (Sequence (Ready p v) (Parallel [t; t'])) (Parallel [Sequence (Ready p v) t;
      Sequence (Ready p v') t']).
  Proof.
    intros Hv H. apply alike_back in H.
    answer H (@None event) (alone w) S
      (By (LStart v' p) (start_on v' p S)
         (Next (Parallel [Sequence (Ready p v) t; Sequence (Running p v') t'])) [Start p v']) T A; [done_by|].
    sole T A.
  Qed.

  (** [(t | t') >> t'' = t | (t' >> t'')]: after a question of [t'], on the left [t''] waits for [t] too. *)
  Theorem sequence_beside_is_no_law (w : world) (S : shared) i x at_site p v u : v <> u ->
    ~ alike_steps (Sequence (Parallel [Ready p v; Confirm i x at_site]) (Ready p u))
                  (Parallel [Ready p v; Sequence (Confirm i x at_site) (Ready p u)]).
  Proof.
    intros Hv H. apply alike_back in H.
    answer H (Some (Answered i true)) (alone w) S (By (LAnswered true) (clear [] S) (Next (Parallel [Ready p v;
      Ready p u])) []) T A;
      [done_by|].
    sole T A. destruct A as (_ & _ & H1).
    answer H1 (@None event) (alone w) (clear [] S)
      (By (LStart u p) (start_on u p (clear [] S)) (Next (Parallel [Ready p v; Running p u])) [Start p u]) T1 A1;
        [done_by|].
    sole T1 A1.
  Qed.

  (** [during { n } run t = during n run t] *)
  Theorem during_code_is_no_law (w : world) (S : shared) k i n d r : ~ alike_steps (During_code k i d r) (During k i
    n r).
  Proof.
    intros H. apply alike_back in H.
    answer H (Some (Expired i)) (alone w) S
      (By LTimeout (does (ensured r) (without (run_of r) S)) (time_out k n) (cut [r])) T A; [done_by|].
    contradiction.
  Qed.

  (** [until { true } run t = action { }] *)
  Theorem until_true_is_no_law (w : world) (S : shared) g a p v : ~ alike_steps (Until Completes g (Ready p v))
    (Action a).
  Proof.
    intros H. destruct (alike_next H (e := None) (K := alone w) (S := S)
      (t := By (LStart v p) (start_on v p S) (Next (Until Completes g (Running p v))) [Start p v])) as (t' & T & A).
    - apply steps_iff_goes. cbn. apply in_app_iff. right. left. reflexivity.
    - apply steps_iff_goes in T. cbn in T. destruct t'. unfold coded, breaks in T.
      destruct (runs a [] _ S); sole T A.
  Qed.

  (** [until { g } run (t >> t') = (until { g } run t) >> (until { g } run t')]: one [g] ends one part. *)
  Theorem until_split_is_no_law (w : world) (S : shared) g x s N ds i n j m :
    runs g [] (alone w) S = Gives x s N ds -> truth x = Some true ->
    ~ alike_steps (Until Completes g (Sequence (Idle i n) (Idle j m)))
                  (Sequence (Until Completes g (Idle i n)) (Until Completes g (Idle j m))).
  Proof.
    intros Hr Hx H.
    destruct (alike_next H (e := None) (K := alone w) (S := S)
      (t := By (LCut ds) (does [] (without [] (with_code s N S))) Ok
              (effects_of ds ++ cut [Sequence (Idle i n) (Idle j m)])))
      as (t' & T & A).
    - apply Itself. cbn [own]. unfold guarded, coded. rewrite Hr, Hx. left. reflexivity.
    - apply steps_iff_goes in T. cbn in T. destruct t'. unfold guarded, coded in T.
      change (runs g [] (enter (In_sequence (Until Completes g (Idle j m))) (alone w)) S) with (runs g [] (alone w)
        S) in T.
      rewrite Hr, Hx in T. sole T A.
  Qed.

  (** [watch (t >> t') onError { ignore() } = (watch t ...) >> (watch t' ...)]: on the left, [t'] is left out. *)
  Theorem watch_split_is_no_law (w : world) (S : shared) h i x at_site (m : message) t : just Ignores h ->
    ~ alike_steps (Watch (Sequence (Confirm i x at_site) t) h) (Sequence (Watch (Confirm i x at_site) h) (Watch t h)).
  Proof.
    intros Hh H.
    assert (He : forall K l S1 m E, on_error h K l S1 m E = [By l S1 Ok (E ++ [])]).
    { intros. unfold on_error. rewrite Hh. cbn. rewrite after_nothing. reflexivity. }
    destruct (alike_next H (e := Some (Nobody_answers i m)) (K := alone w) (S := S) (t := By LNo_answer S Ok []))
      as (t' & T & A).
    - apply steps_iff_goes. cbn. destruct (timer_eq i i); [|congruence]. cbn. rewrite He. left. reflexivity.
    - apply steps_iff_goes in T. cbn in T. destruct t'. destruct (timer_eq i i); [|congruence].
      cbn in T. rewrite He in T. sole T A.
  Qed.

  (** [repeat t until { true } = t]: to ask is a step. *)
  Theorem repeat_until_is_no_law (w : world) (S : shared) more g i n : ~ alike_steps (Repeat (Idle i n) more (Some g)
    (Idle i n)) (Idle i n).
  Proof.
    intros H. apply alike_back in H.
    answer H (Some (Expired i)) (alone w) S (By LTimeout S Ok []) T A; [done_by|]. sole T A.
  Qed.

  (** [(t ensure { D }) >> t' = t >> action { D } >> t'] *)
  Theorem ensure_action_is_no_law (w : world) (S : shared) i n ds a p v :
    ~ alike_steps (Sequence (Ensure (Idle i n) ds) (Ready p v)) (Sequence (Idle i n) (Sequence (Action a) (Ready p v))).
  Proof.
    intros H.
    answer H (Some (Expired i)) (alone w) S (By LTimeout (clear [] (does ds S)) (Next (Ready p v)) []) T A; [done_by|].
    sole T A. destruct A as (_ & _ & H1). exact (action_first_is_no_law w S (alike_back H1)).
  Qed.

  (** [(t | t') ensure { D } = (t ensure { D }) | t']: on the right, D is done when t ends. *)
  Theorem ensure_beside_is_no_law (w : world) (S : shared) i n ds p v : does ds S <> S ->
    ~ alike_steps (Ensure (Parallel [Idle i n; Ready p v]) ds) (Parallel [Ensure (Idle i n) ds; Ready p v]).
  Proof.
    intros Hd H.
    answer H (Some (Expired i)) (alone w) S (By LTimeout S (Next (Ensure (Ready p v) ds)) []) T A; [done_by|].
    sole T A.
  Qed.

  (** [(t >> t') ensure { D } = t >> (t' ensure { D })]: on the right, nothing is ensured while t runs. *)
  Theorem ensure_later_is_no_law (w : world) (S : shared) i x at_site ds t : does ds S <> S ->
    ~ alike_steps (Ensure (Sequence (Confirm i x at_site) t) ds) (Sequence (Confirm i x at_site) (Ensure t ds)).
  Proof.
    intros Hd H. apply alike_back in H.
    answer H (Some (Answered i false)) (alone w) S (By (LAnswered false) S (Err (answered_no at_site x)) []) T A;
      [done_by|].
    sole T A.
  Qed.

  (** [(repeat t) ensure { D } = repeat (t ensure { D })]: on the right, after each round. *)
  Theorem ensure_rounds_is_no_law (w : world) (S : shared) i n ds : clear [] (does ds S) <> clear [] S ->
    ~ alike_steps (Ensure (Repeat (Idle i n) None None (Idle i n)) ds)
                  (Repeat (Ensure (Idle i n) ds) None None (Ensure (Idle i n) ds)).
  Proof.
    intros Hd H.
    answer H (Some (Expired i)) (alone w) S
      (By LTimeout (clear [] S) (Next (Ensure (Repeat (Idle i n) None None (Idle i n)) ds)) [Set_timer i n]) T A;
      [done_by|].
    sole T A.
  Qed.

  (** [until { false } run (t | t') = t | t'] beside an end that may not change places with that of [t']. *)
  Theorem until_beside_is_no_law (w : world) (S : shared) g i x at_site j n m ds es k :
    variables (does es (does ds S)) <> variables (does ds (does es S)) ->
    ~ alike_steps
        (Parallel [Ensure (Idle k n) es; Until Completes g (Parallel [Confirm i x at_site; Ensure (Idle j m) ds])])
        (Parallel [Ensure (Idle k n) es; Confirm i x at_site; Ensure (Idle j m) ds]).
  Proof.
    intros Hd H. apply alike_back in H.
    answer H (Some (Answered i false)) (alone w) S (By (LAnswered false) (does (es ++ ds ++ []) (without [] S))
      (Err (answered_no at_site x)) (cut [Ensure (Idle k n) es; Ensure (Idle j m) ds])) T A; [done_by|].
    sole T A. apply Hd. destruct A as (_ & A & _). apply (f_equal variables) in A. symmetry in A.
    rewrite ?app_nil_r, ?does_app in A. exact A.
  Qed.

  (** [repeat t >> t' = repeat t] fails beside code that asks whether a vehicle of [t'] is held: [t'] names it. *)
  Theorem repeat_then_is_no_law (w : world) (S : shared) a i n p v x s N ds m ds' :
    (forall K, world_of K = w -> runs a [] K S = if held K v then Gives x s N ds else Faulty m ds') ->
    ~ alike_steps (Parallel [Action a; Sequence (Repeat (Idle i n) None None (Idle i n)) (Ready p v)])
                  (Parallel [Action a; Repeat (Idle i n) None None (Idle i n)]).
  Proof.
    intros Ha H.
    set (K := alone w).
    destruct (alike_next H (e := None) (K := K) (S := S)
      (t := By (LAct ds) (with_code s N S) (Next (Sequence (Repeat (Idle i n) None None (Idle i n)) (Ready p v)))
              (effects_of ds))) as (t' & T & A).
    - apply steps_iff_goes. unfold steps; cbn [walk own app]. unfold coded. rewrite Ha by reflexivity. cbn.
      rewrite (proj2 (mem_spec v [v])) by (left; reflexivity). left. reflexivity.
    - apply steps_iff_goes in T. unfold steps in T; cbn [walk own app] in T. unfold coded in T.
      rewrite Ha in T by reflexivity.
      cbn in T. destruct t'. sole T A.
  Qed.
End Not_laws.
