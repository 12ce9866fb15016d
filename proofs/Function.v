(** The step as a function: the list of all transitions of a residual, leftmost first; and that it is the relation. *)
From Dolphin Require Export Tasks.

Section Function.
  Context {L : Names} {C : Code}.

  Inductive transition := By (l : label) (S' : shared) (o : outcome) (E : list effect).

  (** {1 What a step of a part is for the whole around it} *)

  (** [r'] in the place of a part: the normal form of [plug f r']. *)
  Definition replug (f : frame) (r' : residual) : residual :=
    match f with
    | In_sequence t => sequence r' t
    | Beside before after => Parallel (before ++ flat r' ++ after)
    | f => plug f r'
    end.

  (** The part is done. *)
  Definition on_ok (f : frame) (l : label) (S' : shared) (E : list effect) : transition :=
    match f with
    | In_sequence t => By l (clear (keys t) S') (Next t) (E ++ begun t)
    | Beside before after => By l S' (Next (parallel (before ++ after))) E
    | Branch_of bs => By l S' (Next (all_of bs)) E
    | Body_until _ _ | In_watch _ | Held_by _ => By l S' Ok E
    | Body_during _ i _ => By l S' Ok (E ++ [Cancel_timer i])
    | Round_of more None t => By l (clear (keys t) S') (Next (repeat_ t (option_map pred more) None t)) (E ++ begun t)
    | Round_of more (Some g) t => By l S' (Next (Asked more g t)) E
    | In_recruited v => By l S' Ok (E ++ [Release [v]])
    | With_keys ks => By l (clear ks S') Ok E
    | Ensuring ds => By l (does ds S') Ok E
    end.

  (** An error comes to a [watch]. *)
  Definition on_error (h : handler) (K : context) (l : label) (S' : shared) (m : message) (E : list effect)
    : list transition :=
    match handles_error (handles h) m K S' with
    | Rules x s gone N ds =>
        let go o := [By l (after_handler s gone N S') o (E ++ effects_of ds)] in
        match x, anew h with
        | Ignores, _ => go Ok
        | Propagates, _ => go (Err m)
        | Retries, Some (t, q) => go (Next (Watch (Unallocated t q) h))
        | Retries, None => go (Err (foreign_retry (handles h)))
        | Instead t, Some (_, q) =>
            if deepest <=? depth q then go (Err (too_deep (handles h))) else go (Next (Unallocated t (deeper q)))
        | Instead _, None => go (Err m)
        end
    | Breaks m' ds => [By l S' (Err m') (E ++ effects_of (said ds))]
    | Asserts_ m' ds => [By l S' (Ends (Failed m')) (E ++ effects_of (said ds))]
    | Halts_ m' s gone N ds => [By l (after_handler s gone N S') (Ends (Halted m')) (E ++ effects_of ds)]
    | Unclear_ => []
    end.

  Definition on_err (f : frame) (K : context) (l : label) (S' : shared) (m : message) (E : list effect)
    : list transition :=
    match f with
    | Beside before after =>
        [By l (does (flat_map ensured (before ++ after)) (without (flat_map run_of (before ++ after)) S')) (Err m)
           (E ++ cut (before ++ after))]
    | In_watch h => on_error h K l S' m E
    | In_sequence _ | Branch_of _ | Body_until _ _ | Round_of _ _ _ | Held_by _ => [By l S' (Err m) E]
    | Body_during _ i _ => [By l S' (Err m) (E ++ [Cancel_timer i])]
    | In_recruited v => [By l S' (Err m) (E ++ [Release [v]])]
    | With_keys ks => [By l (clear ks S') (Err m) E]
    | Ensuring ds => [By l (does ds S') (Err m) E]
    end.

  Definition lift (f : frame) (K : context) (t : transition) : list transition :=
    match t with
    | By l S' (Next r') E => [By l S' (Next (replug f r')) E]
    | By l S' Ok E => [on_ok f l S' E]
    | By l S' (Err m) E => on_err f K l S' m E
    | By l S' (Ends x) E => [By l S' (Ends x) E]
    end.

  (** {1 Steps of a node itself} *)

  (** Code of a node: what it does if it gives a value, or is faulty; ASSERT-ERR and HALT. *)
  Definition coded (e : option event) (c : code) (ys : list value) (K : context) (S : shared)
      (gives : value -> store -> tuples -> list deed -> list transition)
      (faulty : message -> list deed -> list transition) : list transition :=
    match e with
    | Some _ => []
    | None =>
        match runs c ys K S with
        | Gives x s N ds => gives x s N ds
        | Faulty m ds => faulty m ds
        | Asserts m ds => [By (LBroken m) S (Ends (Failed m)) (effects_of (said ds))]
        | Halts m s N ds => [By (LHalt m) (with_code s N S) (Ends (Halted m)) (effects_of ds)]
        | Unclear => []
        end
    end.

  (** A guard: what it does if it is true, or is not; a fault of what is unknown is no step. *)
  Definition guarded (e : option event) (g : code) (K : context) (S : shared)
      (holds : store -> tuples -> list deed -> list transition) (fails : list transition)
      (faulty : message -> list deed -> list transition) : list transition :=
    coded e g [] K S
      (fun x s N ds => match truth x with Some true => holds s N ds | Some false => fails | None => [] end)
      (fun m ds => if is_unknown m then [] else faulty m ds).

  Definition breaks (S : shared) (m : message) (ds : list deed) : list transition :=
    [By (LBroken m) S (Err m) (effects_of (said ds))].

  (** [f before x after] for each [x] of a list. *)
  Fixpoint each {X Y : Type} (f : list X -> X -> list X -> list Y) (before xs : list X) : list Y :=
    match xs with
    | [] => []
    | x :: after => f before x after ++ each f (before ++ [x]) after
    end.

  Definition choose (e : option event) (K : context) (S : shared) (around : list branch -> residual -> residual)
      (before : list branch) (b : branch) (after : list branch) : list transition :=
    guarded e (fst b) K S
      (fun s N ds => [By (LCheck ds) (clear (keys (snd b)) (with_code s N S))
                        (Next (around (before ++ after) (given ds (snd b))))
                        (effects_of ds ++ begun (snd b))])
      [] (breaks S).

  Definition own (e : option event) (K : context) (S : shared) (r : residual) : list transition :=
    match r with
    | Ready p v =>
        match e with None => [By (LStart v p) (start_on v p S) (Next (Running p v)) [Start p v]] | Some _ => [] end
    | Running p v =>
        match e with
        | Some (Done w) => if vehicle_eq w v then [By (LDone v p) (without [v] S) Ok []] else []
        | Some (Failure w m) =>
            if vehicle_eq w v then [By (LFail v p m) (without [v] S) (Err (plan_failed p v m)) []] else []
        | _ => []
        end
    | Action a =>
        coded e a [] K S (fun _ s N ds => [By (LAct ds) (with_code s N S) Ok (effects_of ds)]) (breaks S)
    | Condition g =>
        guarded e g K S (fun s N ds => [By (LCheck ds) (with_code s N S) Ok (effects_of ds)]) [] (breaks S)
    | All_of bs => each (choose e K S (fun others r => branch_of r others)) [] bs
    | One_of bs => each (choose e K S (fun _ r => r)) [] bs
    | Until k g r =>
        guarded e g K S
          (fun s N ds =>
             match k with
             | Completes => [By (LCut ds) (does (ensured r) (without (run_of r) (with_code s N S))) Ok
                                (effects_of ds ++ cut [r])]
             | Fails _ => []
             end)
          match k with
          | Completes => []
          | Fails at_site =>
              [By (LCut []) (does (ensured r) (without (run_of r) S)) (Err (not_assured at_site g)) (cut [r])]
          end
          (fun m ds => [By (LBroken m) (does (ensured r) (without (run_of r) S)) (Err m)
                          (effects_of (said ds) ++ cut [r])])
    | Idle i _ =>
        match e with Some (Expired j) => if timer_eq j i then [By LTimeout S Ok []] else [] | _ => [] end
    | Confirm i x at_site =>
        match e with
        | Some (Answered j true) => if timer_eq j i then [By (LAnswered true) S Ok []] else []
        | Some (Answered j false) =>
            if timer_eq j i then [By (LAnswered false) S (Err (answered_no at_site x)) []] else []
        | Some (Nobody_answers j m) =>
            if timer_eq j i then [By LNo_answer S (Err (not_answered at_site x m)) []] else []
        | _ => []
        end
    | During k i n r =>
        match e with
        | Some (Expired j) =>
            if timer_eq j i then
              [By LTimeout (does (ensured r) (without (run_of r) S)) (time_out k n) (cut [r])]
            else []
        | _ => []
        end
    | During_code k i d r =>
        coded e d [] K S
          (fun x s N ds =>
             match time_of d x with
             | inl n => [By (LSet_time n) (clear (keys r) (with_code s N S)) (Next (During k i n r))
                           (effects_of ds ++ Set_timer i n :: begun r)]
             | inr m => breaks S m ds
             end)
          (breaks S)
    | Asked more g t =>
        guarded e g K S
          (fun s N ds => [By (LCheck ds) (with_code s N S) Ok (effects_of ds)])
          [By (LCheck []) (clear (keys t) S) (Next (repeat_ t (option_map pred more) (Some g) t)) (begun t)]
          (breaks S)
    | Made a ys q =>
        coded e a ys K S
          (fun x s N ds =>
             match made_task a ys q S x s ds with
             | Some t => [By LMake S (Next (Unallocated t (deeper q))) []]
             | None => let m := no_task a ys (depth q) (variables S) x s ds in [By (LBroken m) S (Err m) []]
             end)
          (breaks S)
    | Unallocated t q =>
        match e with
        | Some _ => []
        | None =>
            match alloc_made (world_of K) (held K) S (free K S) t q (taken_numbers K) with
            | inl (vs, r) => [By (LAllocate vs) (clear (keys r) S) (Next (holding vs r)) (begun r)]
            | inr _ =>
                match alloc_made (world_of K) (held K) S (its_bound K S) t q (taken_numbers K) with
                | inl _ => []
                | inr m => [By (LCannot_execute m) S (Err m) []]
                end
            end
        end
    | Recruit i q a j d =>
        match e with
        | Some (Comes i' v) =>
            if timer_eq i' i then
              if mem v (fit q (world_of K) (bound S)) && negb (named K v) then
                [By (LRecruit v) S
                   (Next (Recruited v
                            (Made a [vehicle_value v] {| allowed := Some [v]; place := j; depth := d |})))
                   [Bind [v]]]
              else []
            else []
        | _ => []
        end
    | Sequence _ _ | Parallel _ | Branch _ _ | Watch _ _ | Repeat _ _ _ _ | Holding _ _ | Recruited _ _ | Fresh _ _
    | Ensure _ _ => []
    end.

  (** {1 The function} *)

  (** What the nodes of [r] give by [here], each carried outwards by [outwards]: that of a node before that of its
      parts, and of [|] from left to right. *)
  Section Walk.
    Context {X : Type}.
    Variables (here : context -> residual -> list X) (outwards : frame -> context -> X -> list X).

    Fixpoint walk (r : residual) (K : context) : list X :=
      let within f r := flat_map (outwards f K) (walk r (enter f K)) in
      here K r ++
      match r with
      | Sequence r t => within (In_sequence t) r
      | Parallel rs =>
          (fix branches (before rs : list residual) : list X :=
             match rs with
             | [] => []
             | r :: after =>
                 flat_map (outwards (Beside before after) K) (walk r (enter (Beside before after) K))
                 ++ branches (before ++ [r]) after
             end) [] rs
      | Branch r bs => within (Branch_of bs) r
      | Until k g r => within (Body_until k g) r
      | During k i n r => within (Body_during k i n) r
      | Watch r h => within (In_watch h) r
      | Repeat r more g t => within (Round_of more g t) r
      | Holding vs r => within (Held_by vs) r
      | Recruited v r => within (In_recruited v) r
      | Fresh ks r => within (With_keys ks) r
      | Ensure r ds => within (Ensuring ds) r
      | _ => []
      end.
  End Walk.

  (** [steps e r K S] is what [r] can do: by itself, or on event [e]. The cut comes before the steps of what it cuts. *)
  Definition steps (e : option event) (r : residual) (K : context) (S : shared) : list transition :=
    walk (fun K => own e K S) lift r K.

  (** {1 Steps by frames}

      The relation once more, in two rules: what a node does itself, and what it does by a part. *)

  Inductive goes (e : option event) : context -> shared -> residual -> transition -> Prop :=
  | Itself : forall K S r t, In t (own e K S r) -> goes e K S r t
  | Within : forall K S f r t t',
      goes e (enter f K) S r t -> In t' (lift f K t) -> goes e K S (plug f r) t'.

  Lemma in_branches (X : Type) (f : list residual -> residual -> list residual -> list X) t rs before :
    In t ((fix branches (before rs : list residual) : list X :=
             match rs with
             | [] => []
             | r :: after => f before r after ++ branches (before ++ [r]) after
             end) before rs)
    <-> exists b r after, rs = b ++ r :: after /\ In t (f (before ++ b) r after).
  Proof.
    revert before. induction rs as [|x rs IH]; intros before.
    - split; [intros []|]. intros (b & r & after & H & _). destruct b; discriminate.
    - rewrite in_app_iff, IH. split.
      + intros [H | (b & r & after & -> & H)].
        * exists [], x, rs. rewrite app_nil_r. auto.
        * exists (x :: b), r, after. split; [reflexivity|]. rewrite <- app_assoc in H. exact H.
      + intros (b & r & after & Hrs & H). destruct b as [|y b]; injection Hrs as -> ->.
        * left. rewrite app_nil_r in H. exact H.
        * right. exists b, r, after. split; [reflexivity|]. rewrite <- app_assoc. exact H.
  Qed.

  Lemma in_each (X Y : Type) (f : list X -> X -> list X -> list Y) (y : Y) xs before :
    In y (each f before xs) <->
    exists b x after, xs = b ++ x :: after /\ In y (f (before ++ b) x after).
  Proof.
    revert before. induction xs as [|x xs IH]; intros before; cbn [each].
    - split; [intros []|]. intros (b & x & after & H & _). destruct b; discriminate.
    - rewrite in_app_iff, IH. split.
      + intros [H | (b & z & after & -> & H)].
        * exists [], x, xs. rewrite app_nil_r. auto.
        * exists (x :: b), z, after. split; [reflexivity|]. rewrite <- app_assoc in H. exact H.
      + intros (b & z & after & Hxs & H). destruct b as [|y' b]; injection Hxs as -> ->.
        * left. rewrite app_nil_r in H. exact H.
        * right. exists b, z, after. split; [reflexivity|]. rewrite <- app_assoc. exact H.
  Qed.

  (** The parts of a residual that may go on. *)
  Definition parts (r : residual) : list (frame * residual) :=
    match r with
    | Sequence r t => [(In_sequence t, r)]
    | Parallel rs => each (fun before r after => [(Beside before after, r)]) [] rs
    | Branch r bs => [(Branch_of bs, r)]
    | Until k g r => [(Body_until k g, r)]
    | During k i n r => [(Body_during k i n, r)]
    | Watch r h => [(In_watch h, r)]
    | Repeat r more g t => [(Round_of more g t, r)]
    | Holding vs r => [(Held_by vs, r)]
    | Recruited v r => [(In_recruited v, r)]
    | Fresh ks r => [(With_keys ks, r)]
    | Ensure r ds => [(Ensuring ds, r)]
    | _ => []
    end.

  Lemma in_parts f r r0 : In (f, r) (parts r0) <-> r0 = plug f r.
  Proof.
    split.
    - destruct r0; cbn; try tauto; try (intros [H | []]; injection H as <- <-; reflexivity).
      rewrite in_each. intros (b & x & after & -> & H). cbn in H. destruct H as [H | []].
      injection H as <- <-. reflexivity.
    - intros ->. destruct f; cbn; auto.
      rewrite in_each. exists before, r, after. cbn. auto.
  Qed.

  Lemma steps_parts e r K S t :
    In t (steps e r K S) <->
    In t (own e K S r) \/
    exists f r1, In (f, r1) (parts r) /\ In t (flat_map (lift f K) (steps e r1 (enter f K) S)).
  Proof.
    assert (One : forall f r1,
      In t (flat_map (lift f K) (steps e r1 (enter f K) S)) <->
      exists f' r1', In (f', r1') [(f, r1)] /\ In t (flat_map (lift f' K) (steps e r1' (enter f' K) S))).
    { intros f r1. split.
      - intros H. exists f, r1. cbn. auto.
      - intros (f' & r1' & [H | []] & H'). injection H as <- <-. exact H'. }
    unfold steps in *. destruct r; cbn [walk parts]; rewrite in_app_iff;
      try (rewrite One; reflexivity);
      try (split; [intros [H | []]; auto | intros [H | (f & r1 & [] & _)]; auto]).
    rewrite (in_branches _ (fun before r after =>
      flat_map (lift (Beside before after) K) (walk (fun K => own e K S) lift r (enter (Beside before after) K)))).
    apply or_iff_compat_l. split.
    - intros (b & r & after & -> & H). exists (Beside b after), r. split; [|exact H].
      apply (proj2 (in_parts (Beside b after) r (Parallel (b ++ r :: after)))). reflexivity.
    - intros (f & r1 & Hin & H). rewrite in_each in Hin. destruct Hin as (b & x & after & -> & [E0 | []]).
      injection E0 as <- <-. cbn in H. exists b, x, after. auto.
  Qed.

  Lemma steps_are_goes e r : forall K S t, In t (steps e r K S) -> goes e K S r t.
  Proof.
    induction r using residual_rect'; intros K S t' Ht; apply steps_parts in Ht;
      destruct Ht as [Ht | (f & part & Hin & Ht)]; try (apply Itself; exact Ht);
      apply in_flat_map in Ht; destruct Ht as (u & H1 & H2);
      (* the only part, or a branch of | *)
      try (cbn in Hin; destruct Hin as [Hin | []]; injection Hin as <- <-);
      try match goal with
      | IH : forall K S t, In t (steps e ?r K S) -> goes e K S ?r t, Hs : In ?u (steps e ?r ?K1 ?S1),
        Hl : In ?t' (lift ?f ?K ?u) |- goes _ _ _ ?whole _ =>
          apply (@Within e K S f r u t' (IH _ _ _ Hs) Hl)
      end;
      try (cbn in Hin; contradiction).
    apply in_parts in Hin. rewrite Hin.
    apply (@Within e K S f part u t'); [|exact H2].
    rewrite Forall_forall in H. apply H; [|exact H1].
    destruct f; cbn in Hin; try discriminate. injection Hin as ->. apply in_elt.
  Qed.

  Lemma goes_are_steps e K S r t : goes e K S r t -> In t (steps e r K S).
  Proof.
    induction 1 as [K S r t H | K S f r t t' _ IH Hl]; apply steps_parts.
    - left. exact H.
    - right. exists f, r. split; [apply in_parts; reflexivity|]. apply in_flat_map. eauto.
  Qed.

  Theorem steps_iff_goes e K S r t : In t (steps e r K S) <-> goes e K S r t.
  Proof. split; [apply steps_are_goes | apply goes_are_steps]. Qed.
End Function.
