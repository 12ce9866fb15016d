(** Residuals are kept in normal form; so what is active always has something to do, to await or to wait for. *)
From Dolphin Require Export Progress.

Section Normal_forms.
  Context {L : Names} {C : Code}.

  Definition is_sequence (r : residual) : bool := match r with Sequence _ _ => true | _ => false end.
  Definition is_parallel (r : residual) : bool := match r with Parallel _ => true | _ => false end.
  Definition some_left (more : option nat) : bool := match more with Some 0 => false | _ => true end.
  Definition solid_handler (h : handler) : bool := match anew h with Some (t, _) => solid t | None => true end.

  (** [>>] leans to the right; [|] is flat, of at least two branches; an [allOf] with one branch left is a [oneOf]; a
      [repeat] has a round to come; [holding] holds somebody; an end does something, and what the program's ends may. *)
  Fixpoint normal (r : residual) : bool :=
    match r with
    | Sequence r t => negb (is_sequence r) && normal r && normal t
    | Parallel rs => (2 <=? length rs) && forallb (fun r => normal r && negb (is_parallel r)) rs
    | Branch r bs => normal r && (1 <=? length bs) && forallb (fun b => normal (snd b)) bs
    | All_of bs => (2 <=? length bs) && forallb (fun b => normal (snd b)) bs
    | One_of bs => (1 <=? length bs) && forallb (fun b => normal (snd b)) bs
    | Repeat r more _ t => normal r && some_left more && normal t
    | Asked more _ t => some_left more && normal t
    | Holding vs r => (1 <=? length vs) && normal r
    | Watch r h => normal r && solid_handler h
    | Unallocated t _ => solid t
    | Ensure r ds => (1 <=? length ds) && forallb may_ensure ds && normal r
    | Until _ _ r | During _ _ _ r | During_code _ _ _ r | Recruited _ r | Fresh _ r => normal r
    | Ready _ _ | Running _ _ | Action _ | Condition _ | Idle _ _ | Confirm _ _ _ | Made _ _ _
    | Recruit _ _ _ _ _ => true
    end.

  Ltac bools := repeat rewrite andb_true_iff in *.

  Lemma normal_sequence r t : normal r = true -> normal t = true -> normal (sequence r t) = true.
  Proof.
    revert t. induction r; intros t0 Hr Ht; cbn [sequence normal] in *; bools;
      try (cbn [is_sequence]; tauto).
    destruct Hr as [[H1 H2] H3]. split; [split|]; auto.
  Qed.

  Definition branches_of (rs : list residual) : bool := forallb (fun r => normal r && negb (is_parallel r)) rs.

  Lemma normal_flat r : normal r = true -> branches_of (flat r) = true /\ flat r <> [].
  Proof.
    unfold branches_of.
    destruct r; intros H; cbn [flat forallb is_parallel negb]; try (rewrite H; split; [reflexivity | discriminate]).
    cbn [normal] in H. bools. destruct H as [H1 H2]. split; [exact H2|]. destruct rs; [discriminate | discriminate].
  Qed.

  Lemma normal_of_branches rs : 2 <= length rs -> branches_of rs = true -> normal (Parallel rs) = true.
  Proof. intros H1 H2. cbn [normal]. bools. split; [apply Nat.leb_le; exact H1 | exact H2]. Qed.

  Lemma branches_app a b : branches_of (a ++ b) = branches_of a && branches_of b.
  Proof. apply forallb_app. Qed.

  Lemma branches_flat rs : forallb normal rs = true -> branches_of (flat_map flat rs) = true.
  Proof.
    induction rs as [|r rs IH]; [reflexivity|]. cbn [forallb flat_map]. rewrite branches_app. bools.
    intros [H1 H2]. split; [apply normal_flat; exact H1 | auto].
  Qed.

  Lemma normal_parallel rs : rs <> [] -> forallb normal rs = true -> normal (parallel rs) = true.
  Proof.
    intros Hn H. pose proof (branches_flat rs H) as Hb. unfold parallel.
    assert (Hf : flat_map flat rs <> []).
    { destruct rs as [|r rs]; [congruence|]. cbn [forallb] in H. bools. cbn [flat_map].
      intros E0. apply app_eq_nil in E0. destruct E0 as [E0 _]. apply (normal_flat r); tauto. }
    destruct (flat_map flat rs) as [|r [|r' rest]] eqn:F; [congruence | |].
    - unfold branches_of in Hb. cbn [forallb] in Hb. bools. tauto.
    - apply normal_of_branches; [cbn; lia | exact Hb].
  Qed.

  Lemma branches_normal rs : branches_of rs = true -> forallb normal rs = true.
  Proof.
    unfold branches_of. rewrite !forallb_forall. intros H r Hr. specialize (H r Hr). bools. tauto.
  Qed.

  Lemma normal_repeat r more g t : normal r = true -> normal t = true -> normal (repeat_ r more g t) = true.
  Proof.
    intros H1 H2. unfold repeat_. destruct more as [[|n]|]; auto; cbn [normal some_left]; bools; auto.
  Qed.

  Lemma normal_all_of bs :
    bs <> [] -> forallb (fun b => normal (snd b)) bs = true -> normal (all_of bs) = true.
  Proof. intros Hn H. destruct bs as [|b [|b' bs]]; [congruence | exact H | exact H]. Qed.

  Lemma normal_branch_of r bs :
    normal r = true -> forallb (fun b => normal (snd b)) bs = true -> normal (branch_of r bs) = true.
  Proof. intros H1 H2. destruct bs; [exact H1|]. cbn [branch_of normal length Nat.leb]. bools. auto. Qed.

  Lemma normal_ensure r ds : normal r = true -> forallb may_ensure ds = true -> normal (ensure_ r ds) = true.
  Proof. intros H1 H2. destruct ds; [exact H1|]. cbn [ensure_ normal]. bools. auto. Qed.

  Lemma normal_given ds r : normal r = true -> normal (given ds r) = true.
  Proof.
    induction r; cbn [given]; auto.
    - destruct (has_parameters a); auto.
    - cbn [normal]. bools. intros [[_ H1] H2]. apply normal_ensure; [apply IHr; exact H2|].
      unfold given_back. rewrite forallb_forall in *. intros d Hd. apply in_flat_map in Hd.
      destruct Hd as (e & He & Hd). specialize (H1 e He).
      destruct e; cbn in Hd; try (destruct Hd as [<- | []]; exact H1).
      apply in_map_iff in Hd. destruct Hd as (x & <- & _). apply give_back_law. exact H1.
  Qed.

  Lemma normal_holding vs r : normal r = true -> normal (holding vs r) = true.
  Proof. destruct vs; cbn; auto. Qed.

  (** {1 What is opened is as good} *)

  Lemma solid_open_each inside t :
    (forall c n t' n', inside c n = inl (t', n') -> solid t' = true) ->
    forall n t' n', open_each inside t n = inl (t', n') -> solid t = true -> solid t' = true.
  Proof.
    intros Hi. assert (Branches : forall bs, Forall (fun b => forall n t' n',
      open_each inside (snd b) n = inl (t', n') -> solid (snd b) = true -> solid t' = true) bs ->
      forall n bs' n',
      (fix each (bs : list (code * task)) (n : nat) : (list (code * task) * nat) + message :=
         match bs with
         | [] => inl ([], n)
         | (g, a) :: bs =>
             match open_each inside a n with
             | inl (a', n1) => match each bs n1 with inl (bs', n2) => inl ((g, a') :: bs', n2) | inr m => inr m end
             | inr m => inr m
             end
         end) bs n = inl (bs', n') ->
      forallb (fun b => solid (snd b)) bs = true ->
      forallb (fun b => solid (snd b)) bs' = true /\ (bs <> [] -> bs' <> [])).
    { induction 1 as [|(g, a) bs Hb _ IH]; intros n bs' n' H Hs.
      - injection H as <- <-. auto.
      - cbn [forallb snd] in *. bools. destruct (open_each inside a n) as [(a' & n1)|] eqn:A; [|discriminate].
        destruct (_ bs n1) as [(bs1 & n2)|] eqn:B; [|discriminate]. injection H as <- <-. cbn [forallb snd]. bools.
        split; [split; [eapply Hb; [exact A | tauto] | eapply IH; [exact B | tauto]] | discriminate]. }
    induction t using task_rect'; intros n0 t' n' Ho Hs; cbn [open_each solid_with] in *; bools;
      try (injection Ho as <- <-; exact Hs);
      try (eapply Hi; exact Ho);
      try (destruct (open_each inside t n0) as [(a' & n1)|] eqn:A; [|discriminate]; injection Ho as <- <-;
           cbn [solid_with]; bools;
           first [eapply IHt; [exact A | tauto] | split; [eapply IHt; [exact A | tauto] | tauto]]).
    - destruct (open_each inside t1 n0) as [(a' & n1)|] eqn:A; [|discriminate].
      destruct (open_each inside t2 n1) as [(b' & n2)|] eqn:B; [|discriminate]. injection Ho as <- <-. cbn [solid_with].
      bools. split; [eapply IHt1; [exact A | tauto] | eapply IHt2; [exact B | tauto]].
    - destruct (open_each inside t1 n0) as [(a' & n1)|] eqn:A; [|discriminate].
      destruct (open_each inside t2 n1) as [(b' & n2)|] eqn:B; [|discriminate]. injection Ho as <- <-. cbn [solid_with].
      bools. split; [eapply IHt1; [exact A | tauto] | eapply IHt2; [exact B | tauto]].
    - destruct (_ bs n0) as [(bs' & n1)|] eqn:B; [|discriminate]. injection Ho as <- <-. cbn [solid_with]. bools.
      destruct (Branches bs H _ _ _ B) as [H1 H2]; [tauto|]. split; [|exact H1].
      destruct bs; [destruct Hs; discriminate|]. destruct bs'; [exfalso; apply H2; [discriminate | reflexivity] |
        reflexivity].
    - destruct (_ bs n0) as [(bs' & n1)|] eqn:B; [|discriminate]. injection Ho as <- <-. cbn [solid_with]. bools.
      destruct (Branches bs H _ _ _ B) as [H1 H2]; [tauto|]. split; [|exact H1].
      destruct bs; [destruct Hs; discriminate|]. destruct bs'; [exfalso; apply H2; [discriminate | reflexivity] |
        reflexivity].
  Qed.

  Lemma made_solid a ys q S x s ds t : made_task a ys q S x s ds = Some t -> solid t = true.
  Proof.
    unfold made_task. intros M. destruct (negb (takes a ys)); [discriminate|].
    destruct (deepest <=? depth q); [discriminate|]. destruct ds; [|discriminate].
    destruct (store_eq s (variables S)); [|discriminate]. eapply task_law. exact M.
  Qed.

  Lemma solid_opened_with fuel w h S key : forall q t n t' n',
    opened_with fuel w h S key q t n = inl (t', n') -> solid t = true -> solid t' = true.
  Proof.
    induction fuel as [|fuel IH]; intros q t n t' n'; cbn [opened_with]; apply solid_open_each; clear t n t' n';
      intros c n t' n' H;
      destruct (run c _ w h S) as [x s N ds | m ds | m ds | m s N ds |]; try discriminate;
      destruct (made_task c _ q S x s ds) as [t1|] eqn:M; try discriminate.
    destruct (opened_with fuel w h S key _ t1 _) as [(t2 & n2)|] eqn:O; [|discriminate]. injection H as <- <-.
    cbn [solid_with]. eapply IH; [exact O | eapply made_solid; exact M].
  Qed.

  Lemma solid_opened w h S key q t n t' n' : opened w h S key q t n = inl (t', n') -> solid t = true -> solid t' = true.
  Proof. Transparent opened. apply solid_opened_with. Qed.
  Opaque opened.

  Lemma solid_unopened t : solid t = true -> solid (unopened t) = true.
  Proof.
    induction t using task_rect'; cbn [unopened solid_with]; bools; try tauto.
    - intros [H1 H2]. split; [destruct bs; [discriminate | reflexivity]|]. rewrite forallb_forall in *.
      rewrite Forall_forall in H. intros b Hb. apply in_map_iff in Hb. destruct Hb as (b0 & <- & Hb). cbn. auto.
    - intros [H1 H2]. split; [destruct bs; [discriminate | reflexivity]|]. rewrite forallb_forall in *.
      rewrite Forall_forall in H. intros b Hb. apply in_map_iff in Hb. destruct Hb as (b0 & <- & Hb). cbn. auto.
  Qed.

  (** {1 What is built is in normal form} *)

  Lemma normal_branches (p : supply) ok (bs : list (code * task)) :
    Forall (fun b => forall ok k a b', solid (snd b) = true -> normal (build p ok (snd b) k a b') = true) bs ->
    forall k a b, forallb (fun b => solid (snd b)) bs = true ->
    let rs :=
      (fix branches (bs : list (code * task)) (k a b : nat) : list branch :=
         match bs with
         | [] => []
         | (g, t) :: bs => (g, build p ok t k a b) :: branches bs (k + leaves t) (a + timers t) (b + places t)
         end) bs k a b in
    forallb (fun b => normal (snd b)) rs = true /\ (bs <> [] -> rs <> []).
  Proof.
    induction 1 as [|(g, t) bs Hb _ IH]; intros k a b Hs; [split; [reflexivity | congruence]|].
    cbn [forallb snd] in *. bools. destruct Hs as [H1 H2]. split; [|discriminate].
    destruct (IH (k + leaves t) (a + timers t) (b + places t) H2) as [H3 _]. split; [apply Hb; exact H1 | exact H3].
  Qed.

  Lemma normal_build (p : supply) t : forall ok k a b, solid t = true -> normal (build p ok t k a b) = true.
  Proof.
    induction t using task_rect'; intros ok k0 a0 b0 Hs; cbn [build solid_with] in *; try reflexivity; bools.
    - apply normal_sequence; [apply IHt1 | apply IHt2]; tauto.
    - apply normal_parallel; [discriminate|]. cbn [forallb]. rewrite IHt1, IHt2 by tauto. reflexivity.
    - apply IHt. exact Hs.
    - destruct Hs as [H1 H2]. destruct (normal_branches p ok bs H k0 a0 b0 H2) as [H3 H4].
      apply normal_all_of; [apply H4; intros ->; discriminate | exact H3].
    - destruct Hs as [H1 H2]. destruct (normal_branches p ok bs H k0 a0 b0 H2) as [H3 H4]. cbn [normal]. bools.
      split; [|exact H3]. apply Nat.leb_le. destruct bs as [|(g, t) bs]; [discriminate | cbn; lia].
    - apply IHt. exact Hs.
    - destruct d; apply IHt; exact Hs.
    - destruct (may_recover h); cbn [normal]; unfold solid_handler; cbn [anew]; bools; split; auto.
      apply solid_unopened. exact Hs.
    - apply normal_repeat; apply IHt; exact Hs.
    - apply IHt. exact Hs.
    - apply normal_ensure; [apply IHt|]; tauto.
  Qed.

  (** {1 Every step keeps the normal form} *)

  Definition next_normal (t : transition) : Prop := match t with By _ _ (Next r') _ => normal r' = true | _ => True end.

  Ltac is_only H := cbn in H; destruct H as [H | H]; [subst | contradiction].

  Lemma branch_normal (bs b : list branch) g r after :
    bs = b ++ (g, r) :: after -> forallb (fun b => normal (snd b)) bs = true ->
    normal r = true /\ forallb (fun b => normal (snd b)) (b ++ after) = true.
  Proof.
    intros -> H. rewrite forallb_app in *. cbn [forallb snd] in H. bools. tauto.
  Qed.

  Lemma coded_normal e c ys K S gives faulty t :
    In t (coded e c ys K S gives faulty) ->
    (forall x s N ds, In t (gives x s N ds) -> next_normal t) -> (forall m ds, In t (faulty m ds) -> next_normal t) ->
    next_normal t.
  Proof. intros H H1 H2. eapply coded_spec; [exact H | exact H1 | exact H2 |]. intros; subst. exact I. Qed.

  Lemma guarded_normal e g K S holds fails faulty t :
    In t (guarded e g K S holds fails faulty) ->
    (forall s N ds, In t (holds s N ds) -> next_normal t) -> (In t fails -> next_normal t) ->
    (forall m ds, In t (faulty m ds) -> next_normal t) -> next_normal t.
  Proof. intros H H1 H2 H3. eapply guarded_spec; [exact H | exact H1 | exact H2 | exact H3 |]. intros; subst. exact I. Qed.

  Lemma own_normal e K S r t : normal r = true -> In t (own e K S r) -> next_normal t.
  Proof.
    intros Hn Ht. destruct r; cbn [own] in Ht; try contradiction.
    - destruct e; [contradiction|]. is_only Ht. reflexivity.
    - destruct e as [[]|]; try contradiction; destruct (vehicle_eq v0 v); try contradiction; is_only Ht; exact I.
    - eapply coded_normal; [exact Ht | |]; cbv beta; intros; is_only H; exact I.
    - eapply guarded_normal; [exact Ht | | |]; cbv beta; intros; try contradiction; is_only H; exact I.
    - apply in_each in Ht. destruct Ht as (b & (g & r) & after & Hbs & Ht). cbn [app] in Ht.
      cbn [normal] in Hn. bools. destruct Hn as [_ Hn]. destruct (branch_normal _ _ _ _ _ Hbs Hn) as [Hr Ho].
      eapply guarded_normal; [exact Ht | | |]; cbv beta; intros; try contradiction; is_only H; try exact I.
      apply normal_branch_of; [apply normal_given; exact Hr | exact Ho].
    - apply in_each in Ht. destruct Ht as (b & (g & r) & after & Hbs & Ht). cbn [app] in Ht.
      cbn [normal] in Hn. bools. destruct Hn as [_ Hn]. destruct (branch_normal _ _ _ _ _ Hbs Hn) as [Hr Ho].
      eapply guarded_normal; [exact Ht | | |]; cbv beta; intros; try contradiction; is_only H; try exact I.
      apply normal_given. exact Hr.
    - eapply guarded_normal; [exact Ht | | |]; cbv beta; destruct k; intros; try contradiction; is_only H; exact I.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction]. is_only Ht. exact I.
    - destruct e as [[]|]; try contradiction; [destruct yes|]; (destruct (timer_eq i0 i); [|contradiction]);
        is_only Ht; exact I.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction]. is_only Ht.
      destruct k; exact I.
    - eapply coded_normal; [exact Ht | |]; cbv beta; intros.
      + destruct (time_of d x); is_only H; [exact Hn | exact I].
      + is_only H. exact I.
    - cbn [normal] in Hn. bools.
      eapply guarded_normal; [exact Ht | | |]; cbv beta; intros; is_only H; try exact I.
      apply normal_repeat; tauto.
    - eapply coded_normal; [exact Ht | |]; cbv beta; intros.
      + destruct (made_task a ys q S x s ds) as [t0|] eqn:M; is_only H; [|exact I]. cbn.
        unfold made_task in M. destruct (negb (takes a ys)); [discriminate|].
        destruct (deepest <=? depth q); [discriminate|]. destruct ds; [|discriminate].
        destruct (store_eq s (variables S)); [|discriminate]. eapply task_law. exact M.
      + is_only H. exact I.
    - destruct e; [contradiction|].
      destruct (alloc_made (world_of K) (held K) S (free K S) t0 q (taken_numbers K)) as [(vs & r) | m] eqn:A.
      + is_only Ht. unfold alloc_made in A. destruct (opened _ _ _ _ _ _ _) as [(t' & n)|] eqn:O; [|discriminate].
        destruct (assign _ _ _ _); [|discriminate]. injection A as <- <-.
        apply normal_holding, normal_build. eapply solid_opened; [exact O | exact Hn].
      + destruct (alloc_made (world_of K) (held K) S (its_bound K S) t0 q (taken_numbers K)); [contradiction|].
        is_only Ht. exact I.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction].
      destruct (mem v (fit q (world_of K) (bound S)) && negb (named K v)); [|contradiction]. is_only Ht. reflexivity.
  Qed.

  Lemma normal_part f r : normal (plug f r) = true -> normal r = true.
  Proof.
    destruct f; cbn [plug normal]; bools; try tauto.
    intros [_ H]. rewrite forallb_app in H. cbn [forallb] in H. bools. tauto.
  Qed.

  Lemma lift_normal f K r t t' :
    normal (plug f r) = true -> next_normal t -> In t' (lift f K t) -> next_normal t'.
  Proof.
    intros Hn Ht Hin. destruct t as [l S1 [r' | | m | x] E].
    - is_only Hin. cbn [next_normal] in *. destruct f; cbn [plug replug normal] in *; bools; try tauto.
      + apply normal_sequence; tauto.
      + destruct Hn as [H1 H2]. rewrite forallb_app in H2. cbn [forallb] in H2. bools.
        destruct H2 as (H2 & _ & H3). destruct (normal_flat r' Ht) as [F1 F2].
        apply Nat.leb_le in H1. rewrite app_length in H1. cbn in H1.
        split.
        * apply Nat.leb_le. rewrite !app_length. destruct (flat r'); [congruence | cbn; lia].
        * change (branches_of (before ++ flat r' ++ after) = true). rewrite !branches_app. bools. auto.
    - destruct Hin as [Hin | []]. subst. destruct f; cbn [plug on_ok normal] in *; bools; try exact I.
      + cbn. tauto.
      + cbn [next_normal]. destruct Hn as [H1 H2]. apply Nat.leb_le in H1. rewrite app_length in H1. cbn in H1.
        rewrite forallb_app in H2. cbn [forallb] in H2. bools. apply normal_parallel.
        * destruct before; destruct after; cbn in *; try lia; discriminate.
        * rewrite forallb_app. bools. split; apply branches_normal; tauto.
      + cbn [next_normal]. destruct Hn as [[_ H1] H2]. apply normal_all_of; [|exact H2].
        intros ->. discriminate.
      + destruct g as [g|]; cbn [next_normal].
        * cbn [normal]. bools. tauto.
        * apply normal_repeat; tauto.
    - destruct f; cbn [lift on_err] in Hin; try (is_only Hin; exact I).
      unfold on_error in Hin. cbn [plug normal] in Hn. bools. destruct Hn as [_ Hh]. unfold solid_handler in Hh.
      destruct (handles_error (handles h) m K S1) as [x s gone N0 ds | m' ds | m' ds | m' s gone N0 ds |] eqn:R;
        try contradiction; try (is_only Hin; exact I).
      destruct x as [ | | | t].
      + is_only Hin. exact I.
      + is_only Hin. exact I.
      + destruct (anew h) as [(t & q)|] eqn:A; is_only Hin; [|exact I]. cbn [next_normal normal]. unfold solid_handler.
        rewrite A, Hh. reflexivity.
      + destruct (anew h) as [(u & q)|]; [destruct (deepest <=? depth q)|]; is_only Hin; try exact I.
        cbn [next_normal normal]. eapply handler_task_law. exact R.
    - is_only Hin. exact I.
  Qed.

  Theorem steps_keep_normal_forms e K S r l S' r' E :
    normal r = true -> step e K S r l S' (Next r') E -> normal r' = true.
  Proof.
    intros Hn H. apply step_goes in H.
    assert (G : forall e K S r t, goes e K S r t -> normal r = true -> next_normal t).
    { clear. intros e K S r t H. induction H as [K S r t H | K S f r t t' _ IH Hl]; intros Hn.
      - eapply own_normal; eauto.
      - eapply lift_normal; [exact Hn | | exact Hl]. apply IH. eapply normal_part. exact Hn. }
    apply (G _ _ _ _ _ H Hn).
  Qed.

  Theorem always_normal M s N c : reachable M s N c -> forall M' r, control_of c = Exec M' r -> normal r = true.
  Proof.
    induction 1 as [|w e c l c' E _ IH Hs]; intros M' r Hr; [discriminate|].
    destruct Hs; cbn in Hr; try discriminate; try (eapply IH; exact Hr; fail).
    - injection Hr as -> ->. unfold alloc in H0. destruct (opened _ _ _ _ _ _ _) as [(t' & n)|] eqn:O; [|discriminate].
      destruct (assign _ _ _ _); [|discriminate]. injection H0 as <-.
      apply normal_build. eapply solid_opened; [exact O|]. eapply script_task_law. exact H.
    - injection Hr as -> ->. eapply steps_keep_normal_forms; [|exact H]. eapply IH. reflexivity.
  Qed.

  (** {1 Progress of configurations} *)

  Lemma normal_full r : normal r = true -> full r = true.
  Proof.
    induction r using residual_rect'; cbn [normal full]; bools; intros Hn; auto; try tauto.
    - destruct Hn as [H1 H2]. split; [destruct rs; [discriminate | reflexivity]|].
      rewrite forallb_forall in *. rewrite Forall_forall in H. intros r Hr. apply H; [exact Hr|].
      specialize (H2 r Hr). bools. tauto.
    - destruct bs; [destruct Hn; discriminate | reflexivity].
    - destruct bs; [destruct Hn; discriminate | reflexivity].
  Qed.

  (** The machine takes pairs that are in N, and releases vehicles of B. *)
  Definition honest_script : Prop :=
    forall M w S M' s,
      (forall ks, run_script M w S = (Did (Consumed ks), M', s) -> take ks (space S) <> None) /\
      (forall vs, run_script M w S = (Did (Released vs), M', s) -> both (bound S) vs <> []).

  (** What is no end has a transition, or awaits something, or is a deadlock: a task in which all that is active waits
      for guards or vehicles. *)
  Theorem configurations_progress M s N c w :
    closed_world -> honest_script -> reachable M s N c ->
    match control_of c with
    | End _ => True
    | Script _ => exists l c' E, cstep w None c l c' E
    | Wait _ _ => True
    | Exec _ r =>
        (exists l c' E, cstep w None c l c' E) \/ awaits r <> [] \/ stuck (alone w) (shared_of c) r
    end.
  Proof.
    intros Hc Hs Hr. destruct c as [[M' | M' q | M' r | x] S]; cbn [control_of shared_of]; auto.
    - assert (H : script_steps w M' S <> []).
      { unfold script_steps. destruct (run_script M' w S) as [[x M1] s1] eqn:R.
        destruct (Hs M' w S M1 s1) as [H1 H2].
        destruct x as [ | [ks | ks | x | vs | vs n] | [q | x | n | cl | t] | | | m | m]; try discriminate.
        - destruct (take ks (space S)) eqn:T; [discriminate|]. exfalso. eapply H1; [exact R | exact T].
        - destruct (both (bound S) vs) eqn:T; [|discriminate]. exfalso. eapply H2; [exact R | exact T].
        - destruct (alloc w (with_store s1 S) t); discriminate. }
      destruct (some_of _ _ H) as [[l c' E] Hin]. exists l, c', E. apply configurations_agree. exact Hin.
    - assert (Hf : full r = true) by (apply normal_full; eapply always_normal; [exact Hr | reflexivity]).
      destruct (residuals_progress r Hc (alone w) S Hf) as [(l & S' & o & E & H) | H]; [left | right; exact H].
      destruct o as [r' | | m | x].
      + do 3 eexists. apply (EXECUTING w None M' S r). exact H.
      + do 3 eexists. apply (EXECUTE_DONE w None M' S r). exact H.
      + do 3 eexists. apply (EXECUTE_ERR w None M' S r). exact H.
      + do 3 eexists. apply (ENDS_all w None M' S r). exact H.
  Qed.
End Normal_forms.
