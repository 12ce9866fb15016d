(** Each timer that is set is cancelled once or expires, each question that is put is answered once or withdrawn, and
    each plan that is started ends once: it is done, fails, or is stopped.
      What is open, opened and closed is counted. *)
From Dolphin Require Export Invariants.
Set Implicit Arguments.
Unset Strict Implicit.

Section Once.
  Context {L : Names} {C : Code}.

  Inductive token := Timer (i : timer) | Question (i : timer) | Plan_of (v : vehicle).

  Lemma token_eq : forall a b : token, {a = b} + {a <> b}.
  Proof. decide equality; solve [apply timer_eq | apply vehicle_eq]. Defined.

  Definition cnt (t : token) (ts : list token) : nat := count_occ token_eq ts t.
  Opaque cnt.

  Lemma cnt_app t a b : cnt t (a ++ b) = cnt t a + cnt t b.
  Proof. Transparent cnt. apply count_occ_app. Qed.
  Opaque cnt.

  Lemma cnt_flat_map_app X t (f : X -> list token) a b :
    cnt t (flat_map f (a ++ b)) = cnt t (flat_map f a) + cnt t (flat_map f b).
  Proof. rewrite flat_map_app. apply cnt_app. Qed.

  Lemma cnt_nil t : cnt t [] = 0.
  Proof. Transparent cnt. reflexivity. Qed.
  Opaque cnt.

  (** {1 What is open, and what effects and events do} *)

  Definition token_of (w : timer * wait) : token :=
    match w with (i, Time _) => Timer i | (i, Answer_to _) => Question i end.

  Definition tokens (r : residual) : list token := map token_of (waits r) ++ map Plan_of (run_of r).

  Definition opens (E : list effect) : list token :=
    flat_map (fun x => match x with
      | Set_timer i _ => [Timer i] | Put_question i _ => [Question i] | Start _ v => [Plan_of v]
      | Look_for _ => [Timer script_timer]            (* with its time-out *)
      | _ => [] end) E.

  Definition closes (E : list effect) : list token :=
    flat_map (fun x => match x with
      | Cancel_timer i => [Timer i] | Withdraw_question i => [Question i] | Stop v => [Plan_of v] | _ => [] end) E.

  Definition ends_token (x : option event) : list token :=
    match x with
    | Some (Expired i) => [Timer i]
    | Some (Answered i _) | Some (Nobody_answers i _) => [Question i]
    | Some (Done v) | Some (Failure v _) => [Plan_of v]
    | _ => []
    end.

  Lemma opens_app a b : opens (a ++ b) = opens a ++ opens b. Proof. apply flat_map_app. Qed.
  Lemma closes_app a b : closes (a ++ b) = closes a ++ closes b. Proof. apply flat_map_app. Qed.

  Lemma effects_open ds : opens (effects_of ds) = [] /\ closes (effects_of ds) = [].
  Proof.
    induction ds as [|d ds [IH1 IH2]]; [auto|]. unfold effects_of in *. cbn [flat_map].
    rewrite opens_app, closes_app, IH1, IH2. destruct d; auto.
  Qed.

  Lemma begun_open r : opens (begun r) = map token_of (waits r) /\ closes (begun r) = [].
  Proof.
    unfold begun. induction (waits r) as [|[i []] ws [IH1 IH2]]; [auto | |]; cbn; rewrite <- ?IH1;
      unfold opens, closes in *;
      rewrite ?IH2; auto.
  Qed.

  Lemma ceases_open ws : opens (map ceases ws) = [] /\ closes (map ceases ws) = map token_of ws.
  Proof.
    induction ws as [|[i []] ws [IH1 IH2]]; [auto | |]; cbn; rewrite <- ?IH2; unfold opens, closes in *;
      rewrite ?IH1; auto.
  Qed.

  Lemma stops_open vs : opens (map Stop vs) = [] /\ closes (map Stop vs) = map Plan_of vs.
  Proof. induction vs as [|v vs [IH1 IH2]];
    [auto|]. cbn. rewrite <- IH2. unfold opens, closes in *. rewrite ?IH1. auto. Qed.

  Lemma release_open vs : opens (release vs) = [] /\ closes (release vs) = [].
  Proof. destruct vs; auto. Qed.

  Lemma cnt_tokens_list t rs :
    cnt t (flat_map tokens rs) = cnt t (map token_of (flat_map waits rs)) + cnt t (map Plan_of (flat_map run_of rs)).
  Proof.
    induction rs as [|r rs IH]; [reflexivity|]. cbn [flat_map]. rewrite !map_app, !cnt_app, IH.
    unfold tokens. rewrite cnt_app. lia.
  Qed.

  Lemma cut_open t rs : cnt t (opens (cut rs)) = 0 /\ cnt t (closes (cut rs)) = cnt t (flat_map tokens rs).
  Proof.
    unfold cut. rewrite !opens_app, !closes_app.
    destruct (ceases_open (flat_map waits rs)) as [-> ->], (stops_open (flat_map run_of rs)) as [-> ->],
      (release_open (flat_map recruits rs)) as [-> ->].
    rewrite cnt_tokens_list, !cnt_app, !cnt_nil. lia.
  Qed.

  Local Opaque cut begun effects_of.

  (** {1 Residuals} *)

  Lemma tokens_parallel t rs : cnt t (tokens (Parallel rs)) = cnt t (flat_map tokens rs).
  Proof.
    rewrite cnt_tokens_list. unfold tokens. rewrite cnt_app. cbn [waits]. unfold run_of. cbn [running].
    rewrite (map_flat_map _ _ _ (@fst vehicle plan) running rs). reflexivity.
  Qed.

  Lemma tokens_flat t r : cnt t (flat_map tokens (flat r)) = cnt t (tokens r).
  Proof. destruct r; cbn [flat]; try (cbn [flat_map]; rewrite app_nil_r;
    reflexivity). symmetry. apply tokens_parallel. Qed.

  Lemma tokens_flats t rs : cnt t (flat_map tokens (flat_map flat rs)) = cnt t (flat_map tokens rs).
  Proof.
    induction rs as [|r rs IH]; [reflexivity|]. cbn [flat_map]. rewrite cnt_flat_map_app, IH, tokens_flat, cnt_app.
      reflexivity.
  Qed.

  Lemma tokens_parallel_of t rs : cnt t (tokens (parallel rs)) = cnt t (flat_map tokens rs).
  Proof.
    rewrite <- (tokens_flats t rs). unfold parallel. destruct (flat_map flat rs) as [|r [|r' rest]]; [reflexivity | |].
    - cbn [flat_map]. rewrite app_nil_r. reflexivity.
    - apply tokens_parallel.
  Qed.

  Lemma tokens_same r r' : waits r = waits r' -> running r = running r' -> tokens r = tokens r'.
  Proof. intros H H'. unfold tokens, run_of. rewrite H, H'. reflexivity. Qed.

  Lemma tokens_quiet r : quiet r = true -> tokens r = map token_of (waits r).
  Proof. intros H. unfold tokens, run_of. rewrite quiet_running by exact H. apply app_nil_r. Qed.

  Lemma tokens_sequence a b : tokens (sequence a b) = tokens a.
  Proof. apply tokens_same; [apply waits_sequence | apply running_sequence]. Qed.
  Lemma tokens_repeat r more g t : tokens (repeat_ r more g t) = tokens r.
  Proof. apply tokens_same; [apply waits_repeat | apply running_repeat]. Qed.
  Lemma tokens_branch_of r bs : tokens (branch_of r bs) = tokens r.
  Proof. apply tokens_same; [apply waits_branch_of | apply running_branch_of]. Qed.
  Lemma tokens_all_of bs : tokens (all_of bs) = [].
  Proof. unfold tokens, run_of. rewrite waits_all_of, running_all_of. reflexivity. Qed.
  Lemma tokens_given ds r : tokens (given ds r) = tokens r.
  Proof. destruct (given_same ds r) as (_ & H & _ & H' & _). apply tokens_same; assumption. Qed.

  (** {1 Each step} *)

  Definition conserves (x : option event) (r : residual) (u : transition) : Prop :=
    match u with
    | By _ _ o E => forall t,
        match o with
        | Next r' => cnt t (tokens r) + cnt t (opens E) = cnt t (tokens r') + cnt t (closes E) + cnt t (ends_token x)
        | Ok => cnt t (tokens r) + cnt t (opens E) = cnt t (closes E) + cnt t (ends_token x)
        | Err _ => cnt t (opens E) = 0 /\ cnt t (tokens r) = cnt t (closes E) + cnt t (ends_token x)
        | Ends _ => cnt t (opens E) = 0 /\ cnt t (closes E) + cnt t (ends_token x) <= cnt t (tokens r)
        end
    end.

  Definition built (r : residual) : Prop := exists X, Wf X r.

  Ltac counts :=
    repeat match goal with
    | |- context [opens (effects_of ?ds)] => rewrite (proj1 (effects_open ds))
    | |- context [closes (effects_of ?ds)] => rewrite (proj2 (effects_open ds))
    | |- context [opens (begun ?r)] => rewrite (proj1 (begun_open r))
    | |- context [closes (begun ?r)] => rewrite (proj2 (begun_open r))
    | |- context [opens (?a ++ ?b)] => rewrite (opens_app a b)
    | |- context [closes (?a ++ ?b)] => rewrite (closes_app a b)
    | |- context [cnt ?t (?a ++ ?b)] => rewrite (cnt_app t a b)
    | |- context [cnt ?t (opens (cut ?rs))] => rewrite (proj1 (cut_open t rs))
    | |- context [cnt ?t (closes (cut ?rs))] => rewrite (proj2 (cut_open t rs))
    end.

  Ltac is_only H := cbn in H; destruct H as [H | H]; [subst | contradiction].

  Lemma coded_conserves e c ys K S gives faulty r u : In u (coded e c ys K S gives faulty) ->
    (forall x s N ds, e = None -> In u (gives x s N ds) -> conserves e r u) ->
    (forall m ds, e = None -> In u (faulty m ds) -> conserves e r u) -> conserves e r u.
  Proof.
    unfold coded. destruct e; [intros []|].
    destruct (runs c ys K S) as [x s N ds | m ds | m ds | m s N ds |]; intros H Hg Hf; eauto; try contradiction;
      is_only H; intros t; counts; cbn; rewrite ?cnt_nil; lia.
  Qed.

  Lemma guarded_conserves e g K S holds fails faulty r u : In u (guarded e g K S holds fails faulty) ->
    (forall s N ds, e = None -> In u (holds s N ds) -> conserves e r u) ->
    (e = None -> In u fails -> conserves e r u) ->
    (forall m ds, e = None -> In u (faulty m ds) -> conserves e r u) -> conserves e r u.
  Proof.
    unfold guarded. intros H Hh Hn Hf. eapply coded_conserves; [exact H | |]; cbv beta.
    - intros x s N ds He Hin. destruct (truth x) as [[]|]; eauto; contradiction.
    - intros m ds He Hin. destruct (is_unknown m); [contradiction | eauto].
  Qed.

  Lemma own_conserves e K S r u : built r -> In u (own e K S r) -> conserves e r u.
  Proof.
    intros (X & W) Hu. destruct r; cbn [own] in Hu; try contradiction.
    - destruct e; [contradiction|]. is_only Hu. intros t.
      change (0 + cnt t [Plan_of v] = cnt t [Plan_of v] + 0 + 0). lia.
    - destruct e as [[]|]; try contradiction; destruct (vehicle_eq v0 v) as [->|]; try contradiction; is_only Hu;
        intros t; cbn; rewrite ?cnt_nil; lia.
    - eapply coded_conserves; [exact Hu | |]; cbv beta; intros; subst e; is_only H0; intros t; counts; cbn;
      rewrite ?cnt_nil; lia.
    - eapply guarded_conserves; [exact Hu | | |]; cbv beta; intros; subst e; try contradiction; is_only H0; intros t;
      counts; cbn; rewrite ?cnt_nil; lia.
    - apply in_each in Hu. destruct Hu as (b & (g & r) & after & Hbs & Hu). cbn [app] in Hu.
      inversion W as [| | | | | | |X' bs' Wb Qb| | | | | | | | | | | | | | | |]; subst X' bs'.
      destruct (branches_split _ _ _ _ _ _ Hbs Wb Qb) as (Wr & Qr & _). unfold choose in Hu. cbn [fst snd] in Hu.
      eapply guarded_conserves; [exact Hu | | |]; cbv beta; intros; subst e; try contradiction; is_only H0; intros t;
        counts.
      + rewrite tokens_branch_of, tokens_given, (tokens_quiet Qr). cbn. rewrite ?cnt_nil. lia.
      + cbn. rewrite ?cnt_nil. lia.
    - apply in_each in Hu. destruct Hu as (b & (g & r) & after & Hbs & Hu). cbn [app] in Hu.
      inversion W as [| | | | | | | |X' bs' Wb Qb| | | | | | | | | | | | | | |]; subst X' bs'.
      destruct (branches_split _ _ _ _ _ _ Hbs Wb Qb) as (Wr & Qr & _). unfold choose in Hu. cbn [fst snd] in Hu.
      eapply guarded_conserves; [exact Hu | | |]; cbv beta; intros; subst e; try contradiction; is_only H0; intros t;
        counts.
      + rewrite tokens_given, (tokens_quiet Qr). cbn. rewrite ?cnt_nil. lia.
      + cbn. rewrite ?cnt_nil. lia.
    - assert (T : tokens (Until k g r) = tokens r) by reflexivity.
      eapply guarded_conserves; [exact Hu | | |]; cbv beta; intros; subst e; destruct k; try contradiction;
        (is_only H || is_only H0); intros t; counts; rewrite T; cbn [flat_map ends_token];
          rewrite app_nil_r, ?cnt_nil; lia.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i) as [->|]; [|contradiction]. is_only Hu.
      intros t. cbn. rewrite ?cnt_nil. lia.
    - destruct e as [[]|]; try contradiction; [destruct yes|]; (destruct (timer_eq i0 i) as [->|]; [|contradiction]);
        is_only Hu; intros t; cbn; rewrite ?cnt_nil; lia.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i) as [->|]; [|contradiction]. is_only Hu.
      intros t. assert (T : cnt t (tokens (During k i n r)) = cnt t [Timer i] + cnt t (tokens r)).
      { unfold tokens. cbn [waits map token_of]. change (run_of (During k i n r)) with (run_of r).
        rewrite !cnt_app. change (Timer i :: map token_of (waits r)) with ([Timer i] ++ map token_of (waits r)).
        rewrite cnt_app. lia. }
      destruct k; cbn [time_out]; counts; rewrite T; cbn [flat_map ends_token]; rewrite app_nil_r; lia.
    - inversion W as [| | | | | | | | | | | | |X' k' i' d' r' Wr Qr| | | | | | | | | |]; subst.
      assert (T : tokens (During_code k i d r) = []) by reflexivity.
      eapply coded_conserves; [exact Hu | |]; cbv beta; intros; subst e.
      + destruct (time_of d x) as [n|m]; is_only H0; intros t; counts; rewrite T.
        * change (Set_timer i n :: begun r) with ([Set_timer i n] ++ begun r). counts.
          assert (T' : tokens (During k i n r) = [Timer i] ++ map token_of (waits r)).
          { unfold tokens. change (run_of (During k i n r)) with (run_of r). unfold run_of.
            rewrite (quiet_running _ Qr). apply app_nil_r. }
          rewrite T'. counts. cbn. rewrite ?cnt_nil. lia.
        * cbn. rewrite ?cnt_nil. lia.
      + is_only H0. intros t. counts. rewrite T. cbn. rewrite ?cnt_nil. lia.
    - inversion W as [| | | | | | | | | | | | | | | |X' more' g' t' Wt Qt| | | | | | |]; subst.
      eapply guarded_conserves; [exact Hu | | |]; cbv beta; intros; subst e; (is_only H || is_only H0); intros t0;
        counts.
      + cbn. rewrite ?cnt_nil. lia.
      + rewrite tokens_repeat, (tokens_quiet Qt). cbn. rewrite ?cnt_nil. lia.
      + cbn. rewrite ?cnt_nil. lia.
    - eapply coded_conserves; [exact Hu | |]; cbv beta; intros; subst e.
      + destruct (made_task a ys q S x s ds); is_only H0; intros t1; cbn; rewrite ?cnt_nil; lia.
      + is_only H0. intros t. counts. cbn. rewrite ?cnt_nil. lia.
    - destruct e; [contradiction|].
      destruct (alloc_made (world_of K) (held K) S (free K S) t q (taken_numbers K)) as [(vs & r) | m] eqn:A.
      + is_only Hu. apply alloc_made_built in A. destruct A as (_ & Qr & _). intros t0. counts.
        assert (T : tokens (holding vs r) = tokens r) by (destruct vs; reflexivity).
        rewrite T, (tokens_quiet Qr). cbn. rewrite ?cnt_nil. lia.
      + destruct (alloc_made (world_of K) (held K) S (its_bound K S) t q (taken_numbers K)); [contradiction|].
        is_only Hu.
        intros t0. cbn. rewrite ?cnt_nil. lia.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction].
      destruct (mem v (fit q (world_of K) (bound S)) && negb (named K v)); [|contradiction]. is_only Hu.
      intros t. cbn. rewrite ?cnt_nil. lia.
  Qed.

  Definition frame_tokens (f : frame) : list token :=
    match f with Beside before after => flat_map tokens (before ++ after) | Body_during _ i _ => [Timer i] |
      _ => [] end.

  Lemma tokens_plug t f r : cnt t (tokens (plug f r)) = cnt t (frame_tokens f) + cnt t (tokens r).
  Proof.
    destruct f; cbn [plug frame_tokens]; try (rewrite cnt_nil; reflexivity).
    - rewrite tokens_parallel, !cnt_flat_map_app. change (r :: after) with ([r] ++ after). rewrite cnt_flat_map_app.
      cbn [flat_map]. rewrite app_nil_r. lia.
    - unfold tokens. change (run_of (During k i n r)) with (run_of r). cbn [waits map token_of].
      change (Timer i :: map token_of (waits r)) with ([Timer i] ++ map token_of (waits r)). rewrite !cnt_app. lia.
  Qed.

  Lemma tokens_replug t f r : cnt t (tokens (replug f r)) = cnt t (frame_tokens f) + cnt t (tokens r).
  Proof.
    destruct f; cbn [replug]; try apply tokens_plug.
    - rewrite tokens_sequence. cbn. rewrite cnt_nil. reflexivity.
    - rewrite tokens_parallel, !cnt_flat_map_app, tokens_flat. cbn [frame_tokens]. rewrite cnt_flat_map_app. lia.
  Qed.

  Definition quiet_frame (f : frame) : Prop :=
    match f with In_sequence t | Round_of _ _ t => quiet t = true | _ => True end.

  Lemma built_part f r : built (plug f r) -> built r /\ quiet_frame f.
  Proof.
    intros (X & W). destruct f; cbn [plug quiet_frame] in *; inversion W; subst; (split; [|auto]); try (eexists;
      eassumption).
    exists X. match goal with H : forall r, In r _ -> Wf X r |- _ => apply H, in_elt end.
  Qed.

  Lemma lift_conserves f K x r u u' :
    built (plug f r) -> conserves x r u -> In u' (lift f K u) -> conserves x (plug f r) u'.
  Proof.
    intros Hb Hc Hu. destruct (built_part Hb) as [_ Q]. destruct u as [l S1 o E]. cbn [conserves] in Hc.
    destruct o as [r' | | m | e].
    - cbn in Hu. destruct Hu as [<- | []]. intros t. specialize (Hc t). rewrite tokens_plug, tokens_replug. lia.
    - cbn [lift] in Hu. destruct Hu as [<- | []].
      destruct f as [| | | | | | ? g ? | | | |]; [..|destruct g|idtac|idtac|idtac|idtac];
        cbn [on_ok conserves]; intros t0; specialize (Hc t0);
        rewrite tokens_plug; cbn [frame_tokens]; rewrite ?cnt_nil; counts.
      + rewrite (tokens_quiet Q). rewrite cnt_nil. lia.
      + rewrite tokens_parallel_of. lia.
      + rewrite tokens_all_of, cnt_nil. lia.
      + lia.
      + cbn. rewrite ?cnt_nil. lia.
      + lia.
      + cbn. rewrite ?cnt_nil. lia.
      + rewrite tokens_repeat, (tokens_quiet Q), cnt_nil. lia.
      + lia.
      + cbn. rewrite ?cnt_nil. lia.
      + lia.
      + lia.
    - destruct f; cbn [lift on_err] in Hu;
        try (destruct Hu as [<- | []]; cbn [conserves]; intros t0; specialize (Hc t0); rewrite tokens_plug;
             cbn [frame_tokens]; rewrite ?cnt_nil; counts; cbn; rewrite ?cnt_nil; lia).
      unfold on_error in Hu.
      destruct (handles_error (handles h) m K S1) as [y s gone N0 ds | m' ds | m' ds | m' s gone N0 ds |];
        try contradiction.
      2, 3, 4: destruct Hu as [<- | []]; cbn [conserves]; intros t0; specialize (Hc t0); rewrite tokens_plug;
             cbn [frame_tokens]; rewrite ?cnt_nil; counts; rewrite ?cnt_nil; lia.
      destruct y; [ | | destruct (anew h) as [(t0 & q)|] | destruct (anew h) as [(t0 & q)|];
        [destruct (deepest <=? depth q)|]];
        destruct Hu as [<- | []]; cbn [conserves]; intros t1; specialize (Hc t1); rewrite tokens_plug;
        cbn [frame_tokens]; rewrite ?cnt_nil; counts; cbn; rewrite ?cnt_nil; lia.
    - cbn in Hu. destruct Hu as [<- | []]. intros t. specialize (Hc t). rewrite tokens_plug. lia.
  Qed.

  Lemma goes_conserves x K S r u : goes x K S r u -> built r -> conserves x r u.
  Proof.
    induction 1 as [K S r u H | K S f r u u' _ IH Hl]; intros Hb; [eapply own_conserves; eassumption|].
    eapply lift_conserves; [exact Hb | apply IH; apply (built_part Hb) | exact Hl].
  Qed.

  (** {1 What A says after an error or an end} *)

  (** Where no plan was started, A has lost the plans that were stopped, or that the event ended. *)
  Definition loses (x : option event) (S : shared) (u : transition) : Prop :=
    match u with
    | By _ S1 (Err _) E | By _ S1 (Ends _) E =>
        forall v, allocation S1 v =
          if in_dec token_eq (Plan_of v) (closes E ++ ends_token x) then None else allocation S v
    | _ => True
    end.

  Lemma closes_cut_plan v rs : In (Plan_of v) (closes (cut rs)) <-> In v (flat_map run_of rs).
  Proof.
    Transparent cut. unfold cut. Opaque cut. rewrite !closes_app, !in_app_iff.
    rewrite (proj2 (ceases_open _)), (proj2 (stops_open _)), (proj2 (release_open _)). split.
    - intros [H | [H | []]]; apply in_map_iff in H; destruct H as (y & Hy & H).
      + destruct y as [i []]; discriminate.
      + injection Hy as ->. exact H.
    - intros H. right. left. apply in_map_iff. exists v. auto.
  Qed.

  Lemma in_dec_if X (t : token) a b (p q : X) : (In t a <-> In t b) ->
    (if in_dec token_eq t a then p else q) = (if in_dec token_eq t b then p else q).
  Proof. intros H. destruct (in_dec token_eq t a), (in_dec token_eq t b); tauto. Qed.

  Lemma loses_nothing x S l S1 o E : (forall v, ~ In (Plan_of v) (closes E ++ ends_token x)) ->
    allocation S1 = allocation S -> loses x S (By l S1 o E).
  Proof.
    intros H HS. destruct o; cbn [loses]; auto; intros v; rewrite HS;
      destruct (in_dec token_eq (Plan_of v) (closes E ++ ends_token x)) as [I | I]; auto; destruct (H v I).
  Qed.

  Lemma loses_cut r l S m E x S0 : closes E = closes (cut [r]) -> ends_token x = [] \/ (exists i,
    ends_token x = [Timer i]) ->
    allocation S0 = allocation S -> loses x S (By l (does (ensured r) (without (run_of r) S0)) (Err m) E).
  Proof.
    intros HE Hx HS v. rewrite HE. cbn [does without with_allocation allocation]. rewrite HS.
    assert (H : In (Plan_of v) (closes (cut [r]) ++ ends_token x) <-> In v (run_of r)).
    { rewrite in_app_iff, closes_cut_plan. cbn [flat_map]. rewrite app_nil_r. split; [|auto].
      intros [H | H]; [exact H|].
      destruct Hx as [Hx | (i & Hx)]; rewrite Hx in H; [destruct H | destruct H as [H | []]; discriminate]. }
    destruct (mem v (run_of r)) eqn:M; destruct (in_dec token_eq (Plan_of v) (closes (cut [r]) ++ ends_token x)) as
      [I | I];
      auto.
    - exfalso. apply I, H, mem_spec, M.
    - exfalso. apply H, mem_spec in I. congruence.
  Qed.

  Ltac no_plan := let v := fresh in intros v; counts; cbn; repeat rewrite (proj2 (effects_open _)); cbn;
    intuition discriminate.

  Lemma coded_loses e c ys K S gives faulty u : In u (coded e c ys K S gives faulty) ->
    (forall x s N ds, e = None -> In u (gives x s N ds) -> loses e S u) ->
    (forall m ds, e = None -> In u (faulty m ds) -> loses e S u) -> loses e S u.
  Proof.
    unfold coded. destruct e; [intros []|].
    destruct (runs c ys K S) as [x s N ds | m ds | m ds | m s N ds |]; intros H Hg Hf; eauto; try contradiction;
      is_only H; apply loses_nothing; try reflexivity; no_plan.
  Qed.

  Lemma guarded_loses e g K S holds fails faulty u : In u (guarded e g K S holds fails faulty) ->
    (forall s N ds, e = None -> In u (holds s N ds) -> loses e S u) -> (e = None -> In u fails -> loses e S u) ->
    (forall m ds, e = None -> In u (faulty m ds) -> loses e S u) -> loses e S u.
  Proof.
    unfold guarded. intros H Hh Hn Hf. eapply coded_loses; [exact H | |]; cbv beta.
    - intros x s N ds He Hin. destruct (truth x) as [[]|]; eauto; contradiction.
    - intros m ds He Hin. destruct (is_unknown m); [contradiction | eauto].
  Qed.

  Lemma own_loses e K S r u : In u (own e K S r) -> loses e S u.
  Proof.
    intros Hu. destruct r; cbn [own] in Hu; try contradiction.
    - destruct e; [contradiction|]. is_only Hu. exact I.
    - destruct e as [[]|]; try contradiction; destruct (vehicle_eq v0 v) as [->|]; try contradiction; is_only Hu;
        [exact I|]. cbn [loses]. intros u.
      cbn [without with_allocation allocation closes flat_map app ends_token].
      destruct (mem u [v]) eqn:M; destruct (in_dec token_eq (Plan_of u) [Plan_of v]) as [J | J]; auto.
      + exfalso. apply J. apply mem_spec in M. destruct M as [-> | []]. left. reflexivity.
      + exfalso. apply mem_false in M. apply M. destruct J as [J | []]. injection J as ->. left. reflexivity.
    - eapply coded_loses; [exact Hu | |]; cbv beta; intros; subst e; is_only H0; apply loses_nothing;
      try reflexivity; no_plan.
    - eapply guarded_loses; [exact Hu | | |]; cbv beta; intros; subst e; try contradiction; is_only H0;
        apply loses_nothing; try reflexivity; no_plan.
    - apply in_each in Hu. destruct Hu as (b & y & after & _ & Hu). unfold choose in Hu.
      eapply guarded_loses; [exact Hu | | |]; cbv beta; intros; subst e; try contradiction; is_only H0;
        [exact I | apply loses_nothing; try reflexivity; no_plan].
    - apply in_each in Hu. destruct Hu as (b & y & after & _ & Hu). unfold choose in Hu.
      eapply guarded_loses; [exact Hu | | |]; cbv beta; intros; subst e; try contradiction; is_only H0;
        [exact I | apply loses_nothing; try reflexivity; no_plan].
    - eapply guarded_loses; [exact Hu | | |]; cbv beta; intros; subst e; destruct k; try contradiction;
        (is_only H || is_only H0); try exact I; apply loses_cut; auto; rewrite ?closes_app, ?(proj2 (effects_open _));
        reflexivity.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i) as [->|]; [|contradiction]. is_only Hu. exact I.
    - destruct e as [[]|]; try contradiction; [destruct yes|]; (destruct (timer_eq i0 i) as [->|]; [|contradiction]);
        is_only Hu; try exact I; apply loses_nothing; try reflexivity; no_plan.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i) as [->|]; [|contradiction]. is_only Hu.
      destruct k; cbn [time_out]; [exact I|]. apply loses_cut; auto. right. exists i. reflexivity.
    - eapply coded_loses; [exact Hu | |]; cbv beta; intros; subst e.
      + destruct (time_of d x); is_only H0; [exact I | apply loses_nothing; try reflexivity; no_plan].
      + is_only H0. apply loses_nothing; try reflexivity; no_plan.
    - eapply guarded_loses; [exact Hu | | |]; cbv beta; intros; subst e; (is_only H || is_only H0); try exact I;
        apply loses_nothing; try reflexivity; no_plan.
    - eapply coded_loses; [exact Hu | |]; cbv beta; intros; subst e.
      + destruct (made_task a ys q S x s ds); is_only H0; [exact I | apply loses_nothing; try reflexivity; no_plan].
      + is_only H0. apply loses_nothing; try reflexivity; no_plan.
    - destruct e; [contradiction|].
      destruct (alloc_made (world_of K) (held K) S (free K S) t q (taken_numbers K)) as [(vs & r) | m];
        [is_only Hu; exact I|].
      destruct (alloc_made (world_of K) (held K) S (its_bound K S) t q (taken_numbers K)); [contradiction|]. is_only Hu.
      apply loses_nothing; try reflexivity; no_plan.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction].
      destruct (mem v (fit q (world_of K) (bound S)) && negb (named K v)); [|contradiction]. is_only Hu. exact I.
  Qed.

  Lemma loses_more x S l S1 S2 m E E' o : loses x S (By l S1 (Err m) E) -> allocation S2 = allocation S1 ->
    (forall v, ~ In (Plan_of v) (closes E')) -> loses x S (By l S2 o (E ++ E')).
  Proof.
    intros H HS HE. destruct o; cbn [loses] in *; auto; intros v; rewrite HS, H; apply in_dec_if;
      rewrite closes_app, !in_app_iff; specialize (HE v); tauto.
  Qed.

  Lemma lift_loses x f K S u u' : loses x S u -> In u' (lift f K u) -> loses x S u'.
  Proof.
    intros Hl Hu. destruct u as [l S1 o E]. destruct o as [r' | | m | e].
    - destruct Hu as [<- | []]. exact I.
    - destruct Hu as [<- | []].
      destruct f as [| | | | | | ? g ? | | | |]; [..|destruct g|idtac|idtac|idtac|idtac]; exact I.
    - destruct f; cbn [lift on_err] in Hu; try (destruct Hu as [<- | []]; exact Hl).
      + destruct Hu as [<- | []]. cbn [loses] in *. intros v. cbn [does without with_allocation allocation]. rewrite Hl.
        assert (H : In (Plan_of v) (closes (E ++ cut (before ++ after)) ++ ends_token x) <->
                    In (Plan_of v) (closes E ++ ends_token x) \/ In v (flat_map run_of (before ++ after))).
        { rewrite closes_app, !in_app_iff, closes_cut_plan. tauto. }
        destruct (in_dec token_eq (Plan_of v) (closes (E ++ cut (before ++ after)) ++ ends_token x)) as [J | J];
          destruct (mem v (flat_map run_of (before ++ after))) eqn:M;
          destruct (in_dec token_eq (Plan_of v) (closes E ++ ends_token x)) as [J' | J']; auto; exfalso.
        * apply H in J. apply mem_false in M. tauto.
        * apply J, H. right. apply mem_spec. exact M.
        * apply J, H. right. apply mem_spec. exact M.
        * apply J, H. auto.
      + destruct Hu as [<- | []]. eapply loses_more; [exact Hl | reflexivity |]. no_plan.
      + unfold on_error in Hu.
        destruct (handles_error (handles h) m K S1) as [y s gone N0 ds | m' ds | m' ds | m' s gone N0 ds |];
          try contradiction;
          try (destruct Hu as [<- | []]; eapply loses_more; [exact Hl | reflexivity | no_plan]; fail).
        destruct y; [ | | destruct (anew h) as [(t0 & q)|] | destruct (anew h) as [(t0 & q)|];
          [destruct (deepest <=? depth q)|]];
          destruct Hu as [<- | []]; try exact I; eapply loses_more; try exact Hl; try reflexivity; no_plan.
      + destruct Hu as [<- | []]. eapply loses_more; [exact Hl | reflexivity |]. no_plan.
    - destruct Hu as [<- | []]. exact Hl.
  Qed.

  Lemma goes_loses x K S r u : goes x K S r u -> loses x S u.
  Proof. induction 1 as [K S r u H | K S f r u u' _ IH Hl]; [eapply own_loses | eapply lift_loses]; eassumption. Qed.

  (** {1 Ends} *)

  Lemma cnt_in t ts : In t ts <-> 0 < cnt t ts.
  Proof. Transparent cnt. unfold cnt. apply count_occ_In. Qed.
  Opaque cnt.

  Lemma cnt_cons t u ts : cnt t (u :: ts) = cnt t [u] + cnt t ts.
  Proof. change (u :: ts) with ([u] ++ ts). apply cnt_app. Qed.

  Lemma cnt_one t u : cnt t [u] = if token_eq u t then 1 else 0.
  Proof. Transparent cnt. unfold cnt. cbn. destruct (token_eq u t); reflexivity. Qed.
  Opaque cnt.

  Lemma cnt_plans v vs : cnt (Plan_of v) (map Plan_of vs) = count_occ vehicle_eq vs v.
  Proof.
    induction vs as [|u vs IH]; [apply cnt_nil|]. cbn [map count_occ]. rewrite cnt_cons, cnt_one, IH.
    destruct (token_eq (Plan_of u) (Plan_of v)) as [H | H], (vehicle_eq u v) as [H' | H']; try congruence; reflexivity.
  Qed.

  Lemma cnt_plans_no t vs : (forall v, t <> Plan_of v) -> cnt t (map Plan_of vs) = 0.
  Proof.
    intros H. induction vs as [|u vs IH]; [apply cnt_nil|]. cbn [map]. rewrite cnt_cons, cnt_one, IH.
    destruct (token_eq (Plan_of u) t) as [J | J]; [|reflexivity]. exfalso. apply (H u). auto.
  Qed.

  Lemma cnt_waits_no v ws : cnt (Plan_of v) (map token_of ws) = 0.
  Proof.
    induction ws as [|[i []] ws IH]; [apply cnt_nil | |]; cbn [map token_of]; rewrite cnt_cons, cnt_one, IH;
      destruct (token_eq _ _); try discriminate; reflexivity.
  Qed.

  Lemma count_filter (P : vehicle -> bool) vs v :
    count_occ vehicle_eq (List.filter P vs) v = if P v then count_occ vehicle_eq vs v else 0.
  Proof.
    induction vs as [|u vs IH]; [destruct (P v); reflexivity|]. cbn [List.filter count_occ].
    destruct (P u) eqn:E; cbn [count_occ]; rewrite IH; destruct (vehicle_eq u v) as [->|]; try rewrite E;
      try reflexivity.
  Qed.

  Lemma cnt_filter (P : timer -> bool) i t ws : t = Timer i \/ t = Question i ->
    cnt t (map token_of (List.filter (fun w => P (fst w)) ws)) = if P i then cnt t (map token_of ws) else 0.
  Proof.
    intros Ht. induction ws as [|[j n] ws IH]; [destruct (P i); apply cnt_nil|]. cbn [List.filter fst map].
    assert (Hj : i <> j -> cnt t [token_of (j, n)] = 0).
    { intros H. rewrite cnt_one. destruct (token_eq (token_of (j, n)) t) as [J | J]; [|reflexivity].
      exfalso. destruct Ht as [-> | ->], n; cbn in J; congruence. }
    rewrite cnt_cons. destruct (timer_eq i j) as [<- | Hij].
    - destruct (P i) eqn:E; cbn [map]; [rewrite cnt_cons, IH | rewrite IH]; reflexivity.
    - destruct (P j) eqn:E; cbn [map]; [rewrite cnt_cons, (Hj Hij), IH | rewrite IH]; rewrite ?(Hj Hij); reflexivity.
  Qed.

  Lemma one_number i ws : NoDup (map fst ws) ->
    cnt (Timer i) (map token_of ws) + cnt (Question i) (map token_of ws) <= 1.
  Proof.
    intros H. assert (E : cnt (Timer i) (map token_of ws) + cnt (Question i) (map token_of ws) =
                          count_occ timer_eq (map fst ws) i).
    { clear H. induction ws as [|[j n] ws IH]; [rewrite !cnt_nil; reflexivity|]. cbn [map count_occ fst].
      rewrite (cnt_cons (Timer i)), (cnt_cons (Question i)), !cnt_one. destruct n; cbn [token_of];
        (destruct (timer_eq j i) as [->|]; repeat (destruct (token_eq _ _); try congruence); lia). }
    rewrite E. apply NoDup_count_occ. exact H.
  Qed.

  Lemma ceased_in i E : In i (ceased E) <-> In (Timer i) (closes E) \/ In (Question i) (closes E).
  Proof.
    unfold ceased, closes. rewrite !in_flat_map. split.
    - intros (y & Hy & Hi). destruct y; try contradiction; destruct Hi as [<- | []]; [left | right];
        (eexists; split; [exact Hy | left; reflexivity]).
    - intros [(y & Hy & Hi) | (y & Hy & Hi)]; destruct y; try contradiction; destruct Hi as [Hi | []]; try discriminate;
        injection Hi as ->; (eexists; split; [exact Hy | left; reflexivity]).
  Qed.

  Lemma spent_in i x : In i (spent_numbers x) <-> In (Timer i) (ends_token x) \/ In (Question i) (ends_token x).
  Proof.
    destruct x as [[]|]; cbn; split; intros H; try tauto; try (intuition discriminate);
      try (destruct H as [-> | []]; auto); destruct H as [[H | []] | [H | []]]; try discriminate; injection H as ->;
        auto.
  Qed.

  Definition is_plan (t : token) : Prop := exists v, t = Plan_of v.
  Definition distinct_waits (r : residual) : Prop := NoDup (map fst (waits r)).

  Lemma stops_closes x r E S : closes (stops x r E S) =
    map token_of (List.filter (fun w => negb (timer_mem (fst w) (spent_numbers x ++ ceased E))) (waits r))
    ++ map Plan_of (still S (run_of r)).
  Proof. unfold stops. rewrite closes_app, (proj2 (ceases_open _)), (proj2 (stops_open _)). reflexivity. Qed.

  Lemma stops_opens x r E S : opens (stops x r E S) = [].
  Proof. unfold stops. rewrite opens_app, (proj1 (ceases_open _)), (proj1 (stops_open _)). reflexivity. Qed.

  (** The end closes what is left. *)
  Lemma stops_rest x r E S S' l y t :
    NoDup (run_of r) -> (forall v, allocation S v = run_at r v) -> is_plan t \/ distinct_waits r ->
    conserves x r (By l S' (Ends y) E) -> loses x S (By l S' (Ends y) E) ->
    cnt t (tokens r) = cnt t (closes E) + cnt t (closes (stops x r E S')) + cnt t (ends_token x).
  Proof.
    intros Hn HA Ht Hc Hl. rewrite stops_closes, cnt_app. cbn [conserves loses] in Hc, Hl.
    destruct (Hc t) as [_ Hle]. unfold tokens in Hle |- *. rewrite cnt_app in Hle |- *.
    destruct t as [i | i | v].
    3: { rewrite !cnt_waits_no in *. rewrite !cnt_plans in *. unfold still. rewrite count_filter, Hl, HA.
         assert (H1 : count_occ vehicle_eq (run_of r) v <= 1) by (apply NoDup_count_occ; exact Hn).
         destruct (in_dec token_eq (Plan_of v) (closes E ++ ends_token x)) as [J | J].
         - apply cnt_in in J. rewrite cnt_app in J. lia.
         - assert (J' : cnt (Plan_of v) (closes E ++ ends_token x) = 0).
           { destruct (cnt (Plan_of v) (closes E ++ ends_token x)) eqn:Z; [reflexivity|].
             exfalso. apply J, cnt_in. lia. }
           rewrite cnt_app in J'. destruct (run_at r v) eqn:R; [lia|].
           unfold run_at in R. apply lookup_none in R.
           assert (Z : count_occ vehicle_eq (run_of r) v = 0) by (apply count_occ_not_In; exact R). lia. }
    all: destruct Ht as [(v & Hv) | Hd]; [discriminate|]; assert (H1 := one_number i Hd);
      rewrite !(cnt_plans_no (t := _)) in * by discriminate;
      rewrite (@cnt_filter (fun i => negb (timer_mem i (spent_numbers x ++ ceased E))) i) by auto;
      destruct (Hc (Timer i)) as [_ HT], (Hc (Question i)) as [_ HQ]; unfold tokens in HT, HQ;
        rewrite cnt_app in HT, HQ;
      rewrite (@cnt_plans_no (Timer i)) in HT by discriminate;
        rewrite (@cnt_plans_no (Question i)) in HQ by discriminate;
      destruct (timer_mem i (spent_numbers x ++ ceased E)) eqn:M; cbn [negb].
    1, 3: apply timer_mem_spec, in_app_iff in M; rewrite spent_in, ceased_in, !cnt_in in M; lia.
    all: assert (N : ~ In i (spent_numbers x ++ ceased E)) by (intros H; apply timer_mem_spec in H; congruence);
      rewrite in_app_iff, spent_in, ceased_in, !cnt_in in N; lia.
  Qed.

  (** {1 Configurations} *)

  Definition open_tokens (c : configuration) : list token :=
    match control_of c with
    | Exec _ r => tokens r
    | Wait _ (For_pick _) | Wait _ (For_pause _) => [Timer script_timer]
    | _ => []
    end.

  Lemma filter_all X (P : X -> bool) xs : (forall x, In x xs -> P x = true) -> List.filter P xs = xs.
  Proof.
    induction xs as [|x xs IH]; intros H; [reflexivity|]. cbn. rewrite H by (left; reflexivity). rewrite IH;
      [reflexivity|].
    intros y Hy. apply H. right. exact Hy.
  Qed.

  Lemma filter_none X (P : X -> bool) xs : (forall x, In x xs -> P x = false) -> List.filter P xs = [].
  Proof.
    induction xs as [|x xs IH]; intros H; [reflexivity|]. cbn. rewrite H by (left; reflexivity). apply IH.
    intros y Hy. apply H. right. exact Hy.
  Qed.

  Lemma still_all S r : (forall v, allocation S v = run_at r v) -> still S (run_of r) = run_of r.
  Proof.
    intros H. apply filter_all. intros v Hv. rewrite H. destruct (run_at r v) eqn:E; [reflexivity|].
    apply lookup_none in E. contradiction.
  Qed.

  Lemma still_none S vs : (forall v, allocation S v = None) -> still S vs = [].
  Proof. intros H. apply filter_none. intros v _. rewrite H. reflexivity. Qed.

  (** An interruption closes all that is open. *)
  Lemma stops_interrupted r S t : (forall v, allocation S v = run_at r v) ->
    cnt t (closes (stops None r [] S)) = cnt t (tokens r).
  Proof.
    intros H. rewrite stops_closes, (still_all H). cbn [spent_numbers ceased flat_map app].
    rewrite filter_all; [reflexivity | intros w _; reflexivity].
  Qed.

  Lemma closes_end vs y : opens (release vs ++ [End_ y]) = [] /\ closes (release vs ++ [End_ y]) = [].
  Proof.
    rewrite opens_app, closes_app, (proj1 (release_open vs)), (proj2 (release_open vs)). split; reflexivity.
  Qed.

  Ltac simple_step := cbn [open_tokens control_of script_at waits_at executes ended]; unfold end_here; cbn [app];
    rewrite ?(proj1 (closes_end _ _)), ?(proj2 (closes_end _ _)); cbn; rewrite ?cnt_nil; lia.

  Theorem steps_conserve w x c l c' E t : in_order c -> cstep w x c l c' E ->
    (forall M r, control_of c = Exec M r -> is_plan t \/ distinct_waits r) ->
    cnt t (open_tokens c) + cnt t (opens E) = cnt t (open_tokens c') + cnt t (closes E) + cnt t (ends_token x).
  Proof.
    intros Hi Hs Hd.
    assert (Ex : forall e M r S l S' o E, c = executes M r S -> step e (alone w) S r l S' o E ->
      conserves e r (By l S' o E) /\ loses e S (By l S' o E) /\ placed (alone w) S r /\ NoDup (run_of r) /\
      (forall v, allocation S v = run_at r v)).
    { intros e0 M r S l0 S' o E0 -> H. destruct Hi as [_ (W & A & _)]. apply step_goes in H.
      split; [eapply goes_conserves; [exact H | eexists; exact W] | split; [eapply goes_loses; exact H|]].
      split; [apply placed_alone; assumption | split; [apply (Wf_nodup _ _ W) | exact A]]. }
    destruct Hs; try (simple_step; fail).
    - (* INPUT *) destruct k; cbn; rewrite ?cnt_nil; lia.
    - (* EXECUTE *) cbn [open_tokens control_of script_at executes ends_token]. apply alloc_built in H0.
      destruct H0 as (_ & Q & _). rewrite (tokens_quiet Q), (proj1 (begun_open r)), (proj2 (begun_open r)), !cnt_nil.
        lia.
    - (* EXECUTE-DONE *) destruct (Ex _ _ _ _ _ _ _ _ eq_refl H) as (Hc & _). specialize (Hc t). cbn in Hc |- *.
      rewrite cnt_nil. lia.
    - (* EXECUTE-ERR *) destruct (Ex _ _ _ _ _ _ _ _ eq_refl H) as (Hc & _ & Hp & _). specialize (Hc t).
      cbn [open_tokens control_of executes ended conserves] in Hc |- *. unfold end_by_error.
      rewrite still_none by (intros v; eapply (nothing_runs_after _ _ _ _ _ _ _ _ (sound_alone w) Hp H); eauto).
      cbn [map app]. rewrite opens_app, closes_app, !cnt_app, (proj1 (closes_end _ _)), (proj2 (closes_end _ _)),
        !cnt_nil. lia.
    - (* EXECUTING *) destruct (Ex _ _ _ _ _ _ _ _ eq_refl H) as (Hc & _). exact (Hc t).
    - (* ENDS *) destruct (Ex _ _ _ _ _ _ _ _ eq_refl H) as (Hc & Hl & _ & Hn & HA).
      assert (R := stops_rest Hn HA (Hd _ _ eq_refl) Hc Hl). destruct (Hc t) as [Ho _].
      cbn [open_tokens control_of executes ended]. unfold end_of.
      rewrite !opens_app, !closes_app, !cnt_app, stops_opens, Ho, !cnt_nil.
      rewrite (proj1 (release_open _)), (proj2 (release_open _)). cbn [opens closes flat_map app]. rewrite !cnt_nil.
        lia.
    - (* INTERRUPT *) cbn [open_tokens control_of ended ends_token]. unfold end_of.
      rewrite !opens_app, !closes_app, !cnt_app, stops_opens, !cnt_nil.
      rewrite (proj1 (release_open _)), (proj2 (release_open _)). cbn [opens closes flat_map app]. rewrite !cnt_nil.
      destruct k as [M | M q | M r | y]; cbn [residual_of script_waits].
      + rewrite stops_closes. cbn. rewrite !cnt_nil. lia.
      + rewrite stops_closes. destruct q; cbn; rewrite !cnt_nil; lia.
      + destruct Hi as [_ (_ & A & _)]. cbn in A. rewrite (stops_interrupted t A). cbn. rewrite !cnt_nil. lia.
      + exfalso. eapply H. reflexivity.
    - (* ON-INTERRUPT *) cbn [open_tokens control_of script_at ends_token].
      rewrite !opens_app, !closes_app, !cnt_app, stops_opens, !cnt_nil.
      destruct k as [M0 | M0 q | M0 r | y]; cbn [residual_of script_waits].
      + rewrite stops_closes. cbn. rewrite !cnt_nil. lia.
      + rewrite stops_closes. destruct q; cbn; rewrite !cnt_nil; lia.
      + destruct Hi as [_ (_ & A & _)]. cbn in A. rewrite (stops_interrupted t A). cbn. rewrite !cnt_nil. lia.
      + exfalso. eapply H. reflexivity.
  Qed.

  (** {1 Runs} *)

  (** A run with the events that it takes and the effects that it has. *)
  Inductive history (c : configuration) : list (option event * list effect) -> configuration -> Prop :=
  | No_step : history c [] c
  | One_more : forall h c1 w x l c2 E,
      history c h c1 -> cstep w x c1 l c2 E -> history c (h ++ [(x, E)]) c2.

  Definition all_opened (h : list (option event * list effect)) : list token := flat_map (fun s => opens (snd s)) h.
  Definition all_closed (h : list (option event * list effect)) : list token := flat_map (fun s => closes (snd s)) h.
  Definition all_ended (h : list (option event * list effect)) : list token := flat_map (fun s => ends_token (fst s)) h.

  Lemma history_reachable M s N h c : history (initial M s N) h c -> reachable M s N c.
  Proof. induction 1; [constructor | econstructor; eassumption]. Qed.

  (** On every run: as often as a timer was set, a question put or a plan started, it was cancelled,
    withdrawn or stopped,
      or ended by an event, or is open still. *)
  Theorem opened_is_closed_once M s N h c t :
    history (initial M s N) h c ->
    (forall c1 M1 r, reachable M s N c1 -> control_of c1 = Exec M1 r -> is_plan t \/ distinct_waits r) ->
    cnt t (all_opened h) = cnt t (all_closed h) + cnt t (all_ended h) + cnt t (open_tokens c).
  Proof.
    intros H Hd. induction H as [|h c1 w x l c2 E H IH Hs]; [rewrite !cnt_nil; reflexivity|].
    assert (R := history_reachable H).
    assert (G := steps_conserve (always_in_order _ _ _ _ R) Hs (fun M1 r => Hd c1 M1 r R)).
    unfold all_opened, all_closed, all_ended in *. rewrite !flat_map_app, !cnt_app. cbn [flat_map fst snd].
    rewrite !app_nil_r. lia.
  Qed.

  (** Each plan that is started on a vehicle is done, fails, or is stopped, once; and the vehicle runs one at a time. *)
  Corollary plans_end_once M s N h c v :
    history (initial M s N) h c ->
    cnt (Plan_of v) (all_opened h) =
      cnt (Plan_of v) (all_closed h) + cnt (Plan_of v) (all_ended h) + cnt (Plan_of v) (open_tokens c) /\
    cnt (Plan_of v) (open_tokens c) <= 1.
  Proof.
    intros H. split; [apply (opened_is_closed_once H); intros; left; exists v; reflexivity|].
    assert (I := always_in_order _ _ _ _ (history_reachable H)). destruct c as [[M1 | M1 q | M1 r | y] S]; cbn.
    - rewrite cnt_nil. lia.
    - destruct q; rewrite ?cnt_nil, ?cnt_one; try lia; destruct (token_eq _ _); try discriminate; lia.
    - destruct I as [_ (W & _)]. unfold tokens. rewrite cnt_app, cnt_waits_no, cnt_plans.
      assert (N1 : NoDup (run_of r)) by apply (Wf_nodup _ _ W).
      assert (N2 := proj1 (NoDup_count_occ vehicle_eq (run_of r)) N1 v). lia.
    - rewrite cnt_nil. lia.
  Qed.
End Once.
