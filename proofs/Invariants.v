(** Invariants of every program, at every step: A is exactly what runs; vehicles that run are in B or recruited; no
    vehicle runs two tasks, stands on both sides of a [|] or is recruited twice; nothing of a held vehicle is given away;
    and after the end A and B are empty. *)
From Dolphin Require Export Building.

Section Invariants.
  Context {L : Names} {C : Code}.

  (** {1 Of residuals} *)

  (** The vehicles that a part may use: B, and those that were recruited for it. *)
  Definition usable (K : context) (B : list vehicle) (v : vehicle) : Prop := In v B \/ In v (its_recruits K).

  (** Contexts as they come about: who is held is needed, and who is needed is named. *)
  Record sound (K : context) : Prop := {
    held_needed : forall v, held K v = true -> needed K v = true;
    needed_named : forall v, needed K v = true -> named K v = true
  }.

  Lemma sound_alone w : sound (alone w).
  Proof. split; intros; discriminate. Qed.

  Lemma sound_enter f K : sound K -> sound (enter f K).
  Proof.
    intros [H1 H2]. split; intros v; destruct f; cbn; rewrite ?orb_true_iff; intros H; firstorder.
  Qed.

  (** [r] in its place: well formed; what is held beside it, it does not name; and A says what it runs of all others. *)
  Record placed (K : context) (S : shared) (r : residual) : Prop := {
    well_formed : Wf (usable K (bound S)) r;
    not_held : forall v, held K v = true -> ~ In v (names r);
    runs_exactly : forall v, held K v = false -> allocation S v = run_at r v
  }.

  Definition nothing_runs (K : context) (S : shared) : Prop := forall v, held K v = false -> allocation S v = None.

  Definition kept (K : context) (S : shared) (r : residual) (t : transition) : Prop :=
    match t with
    | By _ _ (Ends _) _ => True
    | By l S' o E =>
        (* what is held runs on *)
        (forall v, held K v = true -> allocation S' v = allocation S v) /\
        (* only what nothing around needs leaves B, and nothing enters it *)
        incl (bound S') (bound S) /\ (forall v, In v (bound S) -> needed K v = true -> In v (bound S')) /\
        match o with
        | Next r' =>
            placed K S' r' /\
            (* nothing of a held vehicle is given away *)
            (forall v, In v (names r') -> In v (names r) \/ held K v = false) /\
            (* who is recruited was named by nothing *)
            (forall v, In v (recruits r') -> In v (recruits r) \/ (named K v = false /\ ~ In v (bound S)))
        | Ok | Err _ => nothing_runs K S'
        | Ends _ => True
        end
    end.

  Lemma mem_or v a vs : a || mem v vs = true <-> a = true \/ In v vs.
  Proof. rewrite orb_true_iff, mem_spec. reflexivity. Qed.

  Lemma mem_or_false v a vs : a || mem v vs = false <-> a = false /\ ~ In v vs.
  Proof. rewrite orb_false_iff, mem_false. reflexivity. Qed.

  Lemma named_inside f K v : named (enter f K) v = false <-> named K v = false /\ ~ In v (frame_names f).
  Proof. apply mem_or_false. Qed.

  Lemma without_spec vs S v : allocation (without vs S) v = if mem v vs then None else allocation S v.
  Proof. reflexivity. Qed.

  (** What a part runs is nothing after it was cut. *)
  Lemma cut_nothing K S r : placed K S r -> nothing_runs K (without (run_of r) S).
  Proof.
    intros [W N R] v Hv. rewrite without_spec. destruct (mem v (run_of r)) eqn:M; [reflexivity|].
    rewrite R by exact Hv. apply lookup_none. apply mem_false. exact M.
  Qed.

  Lemma cut_held K S r v : placed K S r -> held K v = true -> allocation (without (run_of r) S) v = allocation S v.
  Proof.
    intros [W N R] Hv. rewrite without_spec. destruct (mem v (run_of r)) eqn:M; [|reflexivity].
    apply mem_spec in M. exfalso. apply (N v Hv). apply running_named. exact M.
  Qed.

  Lemma quiet_runs_nothing r v : quiet r = true -> run_at r v = None.
  Proof. intros Q. unfold run_at. rewrite quiet_running by exact Q. reflexivity. Qed.

  Lemma placed_quiet K S r :
    Wf (usable K (bound S)) r -> quiet r = true -> (forall v, held K v = true -> ~ In v (names r)) ->
    nothing_runs K S -> placed K S r.
  Proof.
    intros W Q N H. split; auto. intros v Hv. rewrite quiet_runs_nothing by exact Q. apply H. exact Hv.
  Qed.

  (** {2 A node's own steps} *)

  Ltac is_only H := cbn in H; destruct H as [H | H]; [subst | contradiction].

  Lemma coded_spec e c ys K S gives faulty t (P : transition -> Prop) :
    In t (coded e c ys K S gives faulty) ->
    (forall x s N ds, In t (gives x s N ds) -> P t) ->
    (forall m ds, In t (faulty m ds) -> P t) ->
    (forall l S' x E, allocation S' = allocation S -> bound S' = bound S -> t = By l S' (Ends x) E -> P t) ->
    P t.
  Proof.
    unfold coded. intros H Hg Hf He. destruct e; [contradiction|].
    destruct (runs c ys K S) as [x s N ds | m ds | m ds | m s N ds |]; eauto; try contradiction.
    - is_only H. eapply He; [| | reflexivity]; reflexivity.
    - is_only H. eapply He; [| | reflexivity]; reflexivity.
  Qed.

  Lemma guarded_spec e g K S holds fails faulty t (P : transition -> Prop) :
    In t (guarded e g K S holds fails faulty) ->
    (forall s N ds, In t (holds s N ds) -> P t) ->
    (In t fails -> P t) ->
    (forall m ds, In t (faulty m ds) -> P t) ->
    (forall l S' x E, allocation S' = allocation S -> bound S' = bound S -> t = By l S' (Ends x) E -> P t) ->
    P t.
  Proof.
    unfold guarded. intros H Hh Hn Hf He. eapply coded_spec; [exact H | | | exact He].
    - intros x s N ds Hin. cbn in Hin. destruct (truth x) as [[]|]; eauto. contradiction.
    - intros m ds Hin. cbn in Hin. destruct (is_unknown m); [contradiction | eauto].
  Qed.

  (** A step that leaves A and B alone, to [Ok] or [Err] of a part that runs nothing. *)
  Lemma kept_over K S r l S' o E :
    placed K S r -> running r = [] -> allocation S' = allocation S -> bound S' = bound S ->
    match o with Next _ => False | _ => True end -> kept K S r (By l S' o E).
  Proof.
    intros [W N R] Q HA HB Ho. destruct o; try contradiction; try exact I;
      (split; [rewrite HA; auto | rewrite HB; split; [apply incl_refl | split; [auto|]]]);
      intros v Hv; rewrite HA, R by exact Hv; unfold run_at; rewrite Q; reflexivity.
  Qed.

  (** A step that leaves A and B alone, to a residual that runs the same. *)
  Lemma kept_next K S r l S' r' E :
    placed K S r -> allocation S' = allocation S -> bound S' = bound S ->
    Wf (usable K (bound S)) r' -> (forall v, run_at r' v = run_at r v) ->
    (forall v, In v (names r') -> In v (names r)) -> (forall v, In v (recruits r') -> In v (recruits r)) ->
    kept K S r (By l S' (Next r') E).
  Proof.
    intros [W N R] HA HB W' HR HN HC.
    split; [rewrite HA; auto | rewrite HB; split; [apply incl_refl | split; [auto|]]]. split; [split|split].
    - rewrite HB. exact W'.
    - intros v Hv Hin. apply (N v Hv). auto.
    - intros v Hv. rewrite HA, HR. auto.
    - auto.
    - auto.
  Qed.

  Lemma kept_ends K S r l S' x E :
    allocation S' = allocation S -> bound S' = bound S -> kept K S r (By l S' (Ends x) E).
  Proof. intros _ _. exact I. Qed.

  Lemma branches_split (bs : list branch) b g r after (X : vehicle -> Prop) :
    bs = b ++ (g, r) :: after ->
    (forall b, In b bs -> Wf X (snd b)) -> forallb (fun b => quiet (snd b)) bs = true ->
    Wf X r /\ quiet r = true /\ (forall b', In b' (b ++ after) -> Wf X (snd b')) /\
    forallb (fun b => quiet (snd b)) (b ++ after) = true /\
    (forall v, In v (flat_map (fun b => names (snd b)) (b ++ after)) -> In v (flat_map (fun b => names (snd b)) bs)) /\
    (forall v, In v (names r) -> In v (flat_map (fun b => names (snd b)) bs)).
  Proof.
    intros -> W Q. rewrite forallb_app in Q. cbn in Q. rewrite !andb_true_iff in Q. destruct Q as (Q1 & Q2 & Q3).
    rewrite forallb_app, Q1, Q3.
    split; [apply (W (g, r)); apply in_elt | split; [exact Q2|split; [|split; [reflexivity|split]]]].
    - intros b' Hb'. apply W. rewrite in_app_iff in *. cbn. tauto.
    - intros v. rewrite !flat_map_app, !in_app_iff. cbn. rewrite in_app_iff. tauto.
    - intros v. rewrite !flat_map_app, !in_app_iff. cbn. rewrite in_app_iff. tauto.
  Qed.

  Lemma own_kept e K S r t : sound K -> placed K S r -> In t (own e K S r) -> kept K S r t.
  Proof.
    intros HK HP Ht. pose proof HP as [W N R].
    destruct r; cbn [own] in Ht; try contradiction.
    - (* START *)
      destruct e; [contradiction|]. is_only Ht. inversion W; subst.
      assert (Hv : held K v = false).
      { destruct (held K v) eqn:Hv; [|reflexivity]. exfalso. apply (N v Hv). left. reflexivity. }
      split; [|split; [apply incl_refl | split; [auto | split; [split|split]]]]; cbn [start_on with_allocation allocation bound].
      + intros u Hu. destruct (vehicle_eq u v); [congruence | reflexivity].
      + constructor. assumption.
      + intros u Hu [<- | []]. congruence.
      + intros u Hu. unfold run_at. cbn. destruct (vehicle_eq u v); [reflexivity|].
        rewrite R by exact Hu. reflexivity.
      + intros u [<- | []]. left. left. reflexivity.
      + intros u [].
    - (* DONE, FAIL *)
      assert (Hgone : nothing_runs K (without [v] S)).
      { apply (cut_nothing K S (Running p v)). exact HP. }
      assert (Hheld : forall u, held K u = true -> allocation (without [v] S) u = allocation S u).
      { intros u Hu. apply (cut_held K S (Running p v)); assumption. }
      destruct e as [[]|]; try contradiction; destruct (vehicle_eq v0 v) as [->|]; try contradiction; is_only Ht;
        (split; [exact Hheld | split; [apply incl_refl | split; [auto | exact Hgone]]]).
    - eapply coded_spec; [exact Ht | | |]; cbv beta.
      + intros x s N0 ds H. is_only H. apply kept_over; auto.
      + intros m ds H. is_only H. apply kept_over; auto.
      + intros; subst. apply kept_ends; assumption.
    - eapply guarded_spec; [exact Ht | | | |]; cbv beta.
      + intros s N0 ds H. is_only H. apply kept_over; auto.
      + intros [].
      + intros m ds H. is_only H. apply kept_over; auto.
      + intros; subst. apply kept_ends; assumption.
    - (* ALLOF-WHEN *)
      apply in_each in Ht. destruct Ht as (b & (g & r) & after & Hbs & Ht). cbn [app] in Ht.
      inversion W as [| | | | | | |X bs' Wb Qb| | | | | | | | | | | | | | | |]; subst X bs'.
      destruct (branches_split _ _ _ _ _ _ Hbs Wb Qb) as (Wr & Qr & Wo & Qo & No & Nr).
      unfold choose in Ht. cbn [fst snd] in Ht. destruct (given_same (@nil deed) r) as (_ & _ & _ & _ & _).
      eapply guarded_spec; [exact Ht | | | |]; cbv beta.
      + intros s N0 ds H. is_only H. destruct (given_same ds r) as (G1 & G2 & G3 & G4 & G5).
        apply kept_next; auto.
        * apply Wf_branch_of; auto. apply Wf_given. exact Wr.
        * intros v. unfold run_at. rewrite running_branch_of, G2, quiet_running by exact Qr. reflexivity.
        * intros v. rewrite names_branch_of, G1. cbn [names]. intros [Hv | Hv]; auto.
        * intros v. rewrite recruits_branch_of, G3, quiet_recruits by exact Qr. auto.
      + intros [].
      + intros m ds H. is_only H. apply kept_over; auto.
      + intros; subst. apply kept_ends; assumption.
    - (* ONEOF-WHEN *)
      apply in_each in Ht. destruct Ht as (b & (g & r) & after & Hbs & Ht). cbn [app] in Ht.
      inversion W as [| | | | | | | |X bs' Wb Qb| | | | | | | | | | | | | | |]; subst X bs'.
      destruct (branches_split _ _ _ _ _ _ Hbs Wb Qb) as (Wr & Qr & Wo & Qo & No & Nr).
      unfold choose in Ht. cbn [fst snd] in Ht.
      eapply guarded_spec; [exact Ht | | | |]; cbv beta.
      + intros s N0 ds H. is_only H. destruct (given_same ds r) as (G1 & G2 & G3 & G4 & G5).
        apply kept_next; auto.
        * apply Wf_given. exact Wr.
        * intros v. unfold run_at. rewrite G2, quiet_running by exact Qr. reflexivity.
        * intros v. rewrite G1. cbn [names]. auto.
        * intros v. rewrite G3, quiet_recruits by exact Qr. auto.
      + intros [].
      + intros m ds H. is_only H. apply kept_over; auto.
      + intros; subst. apply kept_ends; assumption.
    - (* UNTIL-CUT, ASSURE-CUT *)
      assert (HP' : placed K S r) by (destruct HP; split; auto; inversion well_formed0; assumption).
      assert (HP2 : forall s N, placed K (with_code s N S) r) by (intros; destruct HP'; split; auto).
      eapply guarded_spec; [exact Ht | | | |]; cbv beta.
      + intros s N0 ds H. destruct k; [is_only H | contradiction].
        split; [|split; [apply incl_refl | split; [auto|]]].
        * intros v Hv. apply (cut_held K (with_code s N0 S)); auto.
        * apply (cut_nothing K (with_code s N0 S)). auto.
      + intros H. destruct k; [contradiction | is_only H].
        split; [|split; [apply incl_refl | split; [auto|]]].
        * intros v Hv. apply (cut_held K); auto.
        * apply cut_nothing. auto.
      + intros m ds H. is_only H.
        split; [|split; [apply incl_refl | split; [auto|]]].
        * intros v Hv. apply (cut_held K); auto.
        * apply cut_nothing. auto.
      + intros; subst. apply kept_ends; assumption.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction]. is_only Ht.
      apply kept_over; auto.
    - destruct e as [[]|]; try contradiction.
      + destruct yes; (destruct (timer_eq i0 i); [|contradiction]); is_only Ht; apply kept_over; auto.
      + destruct (timer_eq i0 i); [|contradiction]. is_only Ht. apply kept_over; auto.
    - (* DURING-CUT, WITHIN-CUT *)
      assert (HP' : placed K S r) by (destruct HP; split; auto; inversion well_formed0; assumption).
      destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction]. is_only Ht.
      destruct k; (split; [|split; [apply incl_refl | split; [auto|]]]);
        try (intros v Hv; apply (cut_held K); auto; fail); apply cut_nothing; auto.
    - (* DURING-SET *)
      inversion W; subst.
      eapply coded_spec; [exact Ht | | |]; cbv beta.
      + intros x s N0 ds H. destruct (time_of d x) as [n|m]; is_only H.
        * apply kept_next; auto.
          -- constructor. assumption.
          -- intros v. unfold run_at. cbn. rewrite quiet_running by assumption. reflexivity.
          -- cbn. intros v. rewrite quiet_recruits by assumption. auto.
        * apply kept_over; auto.
      + intros m ds H. is_only H. apply kept_over; auto.
      + intros; subst. apply kept_ends; assumption.
    - (* REPEAT-UNTIL, REPEAT-AGAIN *)
      inversion W; subst.
      eapply guarded_spec; [exact Ht | | | |]; cbv beta.
      + intros s N0 ds H. is_only H. apply kept_over; auto.
      + intros H. is_only H. apply kept_next; auto.
        * apply Wf_repeat; assumption.
        * intros v. unfold run_at. rewrite running_repeat, quiet_running by assumption. reflexivity.
        * intros v Hv. apply names_repeat in Hv. cbn. tauto.
        * intros v. rewrite recruits_repeat, quiet_recruits by assumption. auto.
      + intros m ds H. is_only H. apply kept_over; auto.
      + intros; subst. apply kept_ends; assumption.
    - (* MAKE *)
      eapply coded_spec; [exact Ht | | |]; cbv beta.
      + intros x s N0 ds H. destruct (made_task a ys q S x s ds); is_only H.
        * apply kept_next; auto. constructor.
        * apply kept_over; auto.
      + intros m ds H. is_only H. apply kept_over; auto.
      + intros; subst. apply kept_ends; assumption.
    - (* ALLOCATE *)
      destruct e; [contradiction|].
      destruct (alloc_made (world_of K) (held K) S (free K S) t0 q (taken_numbers K)) as [(vs & r) | m] eqn:A.
      + is_only Ht. apply alloc_made_built in A. destruct A as (Wr & Qr & Nr & Vs).
        assert (Free : forall v, In v (free K S) -> usable K (bound S) v /\ held K v = false).
        { intros v. unfold free, its_bound, usable. rewrite filter_In, in_app_iff, negb_true_iff. auto. }
        assert (Hn : forall v, In v (names (holding vs r)) -> In v (free K S)).
        { intros v. unfold holding. destruct vs as [|u vs]; [auto|]. cbn [names]. rewrite in_app_iff. intros [Hv | Hv]; auto. }
        assert (Hr : running (holding vs r) = running r /\ recruits (holding vs r) = recruits r)
          by (destruct vs; auto).
        destruct Hr as [Hr Hc].
        split; [auto | split; [apply incl_refl | split; [auto | split; [split|split]]]].
        * assert (Wr' : Wf (usable K (bound S)) r).
          { eapply Wf_more; [exact Wr|]. intros v _ Hv. apply Free. exact Hv. }
          unfold holding. destruct vs; [exact Wr' | constructor; exact Wr'].
        * intros v Hv Hin. apply Hn in Hin. apply Free in Hin. destruct Hin. congruence.
        * intros v Hv. unfold run_at. rewrite Hr, quiet_running by exact Qr.
          change (allocation S v = None). rewrite R by exact Hv. reflexivity.
        * intros v Hv. right. apply Free. auto.
        * intros v. rewrite Hc, quiet_recruits by exact Qr. intros [].
      + destruct (alloc_made (world_of K) (held K) S (its_bound K S) t0 q (taken_numbers K)); [contradiction|].
        is_only Ht. apply kept_over; auto.
    - (* RECRUIT *)
      destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction].
      destruct (mem v (fit q (world_of K) (bound S))) eqn:M; [|contradiction]. apply mem_spec, fit_law in M.
      destruct (named K v) eqn:Nm; cbn in Ht; [contradiction|]. is_only Ht.
      assert (Hv : held K v = false).
      { destruct (held K v) eqn:Hv; [|reflexivity]. apply held_needed, needed_named in Hv; auto; congruence. }
      split; [auto | split; [apply incl_refl | split; [auto | split; [split|split]]]].
      + constructor; [cbn; auto | constructor].
      + intros u Hu [<- | []]. congruence.
      + intros u Hu. rewrite R by exact Hu. reflexivity.
      + intros u [<- | []]. auto.
      + intros u [<- | []]. auto.
  Qed.

  (** {2 Steps of a part} *)

  (** What is around [r] in [plug f r], beside and after. *)
  Lemma placed_inside f K S r : placed K S (plug f r) -> placed (enter f K) S r.
  Proof.
    intros [W N R].
    destruct f; cbn [plug] in *;
      try (inversion W; subst; split; cbn [enter held its_recruits];
           [eapply Wf_more; [eassumption|]; unfold usable; cbn; intros u _; rewrite ?in_app_iff; cbn; intuition
           | intros u Hu Hin; apply (N u Hu); cbn [names]; rewrite ?in_app_iff; cbn; auto
           | auto]; fail).
    - (* | *)
      inversion W as [| | | | |X rs Wrs Hap| | | | | | | | | | | | | | | | | |]; subst X rs.
      assert (Hd : forall v, In v (flat_map names (before ++ after)) -> ~ In v (names r)).
      { apply apart_app in Hap. destruct Hap as (_ & [H1 _] & H2). cbn [flat_map] in H2.
        intros v. rewrite flat_map_app, in_app_iff. intros [Hv | Hv] Hr.
        - apply (H2 v Hv). apply in_app_iff. auto.
        - apply (H1 v Hr Hv). }
      split; cbn [enter held its_recruits frame_names].
      + eapply Wf_more; [apply Wrs; apply in_elt|]. unfold usable. cbn. intros v _. rewrite app_nil_r. auto.
      + intros v Hv. apply mem_or in Hv. destruct Hv as [Hv | Hv].
        * intros Hin. apply (N v Hv). cbn [names]. rewrite flat_map_app. cbn [flat_map]. rewrite !in_app_iff. auto.
        * apply Hd. exact Hv.
      + intros v Hv. apply mem_or_false in Hv. destruct Hv as [Hv Ho]. rewrite R by exact Hv. unfold run_at.
        cbn [running]. rewrite flat_map_app in *. cbn [flat_map]. rewrite !lookup_app. rewrite in_app_iff in Ho.
        assert (Hb : lookup v (flat_map running before) = None).
        { apply lookup_none. rewrite map_flat_map. intros H. apply in_flat_map in H. destruct H as (q & Hq & H).
          apply Ho. left. apply in_flat_map. exists q. split; [exact Hq|]. apply running_named. exact H. }
        assert (Ha : lookup v (flat_map running after) = None).
        { apply lookup_none. rewrite map_flat_map. intros H. apply in_flat_map in H. destruct H as (q & Hq & H).
          apply Ho. right. apply in_flat_map. exists q. split; [exact Hq|]. apply running_named. exact H. }
        rewrite Hb, Ha. destruct (lookup v (running r)); reflexivity.
  Qed.

  (** What of the frame outlives a step of the part: its siblings and parts to come have all they need. *)
  Lemma rest_wf K S S' (X : vehicle -> Prop) q f :
    (forall v, In v (bound S) -> needed (enter f K) v = true -> In v (bound S')) ->
    (forall v, X v -> usable K (bound S) v) ->
    (forall v, In v (names q) -> needed (enter f K) v = true) ->
    Wf X q -> Wf (usable K (bound S')) q.
  Proof.
    intros HB HX HN W. eapply Wf_more; [exact W|]. intros v Hv Hx. destruct (HX v Hx) as [Hb | Hr]; [left | right]; auto.
  Qed.

  Lemma handler_kept K S S' r h x s gone N ds m l o E :
    sound K -> placed K S (Watch r h) -> kept (enter (In_watch h) K) S r (By l S' (Err m) E) ->
    handles_error (handles h) m K S' = Rules x s gone N ds ->
    match o with
    | Next r' => running r' = [] /\ names r' = [] /\ recruits r' = [] /\ forall X, Wf X r'
    | Ok | Err _ => True
    | Ends _ => True
    end ->
    kept K S (Watch r h) (By l (after_handler s gone N S') o (E ++ effects_of ds)).
  Proof.
    intros HK HP (H1 & H2 & H3 & H4) Hh Ho. cbn [enter held needed frame_names] in *.
    destruct o as [r' | | m0 | x0]; [..|exact I];
    (assert (HN : forall v, needed K v = true -> ~ In v gone)
       by (intros v Hv Hg; pose proof (handler_law _ _ _ _ _ _ _ _ _ _ _ Hh v Hg); congruence));
    (split; [exact H1 | split; [intros v; cbn; rewrite in_minus; intros [Hv _]; auto | split;
      [intros v Hv Hn; cbn; apply in_minus; split; [apply H3; [exact Hv | apply orb_true_iff; auto] | auto]|]]]).
    - destruct Ho as (O1 & O2 & O3 & O4). split; [split|split].
      + apply O4.
      + intros v _. rewrite O2. intros [].
      + intros v Hv. unfold run_at. rewrite O1. apply H4. exact Hv.
      + intros v. rewrite O2. intros [].
      + intros v. rewrite O3. intros [].
    - exact H4.
    - exact H4.
  Qed.

  Lemma lift_kept f K S r t t' :
    sound K -> placed K S (plug f r) -> kept (enter f K) S r t -> In t' (lift f K t) -> kept K S (plug f r) t'.
  Proof.
    intros HK HP Hk Hin. pose proof HP as [W N R].
    destruct t as [l S1 o E].
    destruct o as [r' | | m | x]; [..|cbn in Hin; destruct Hin as [Hin | []]; subst t'; exact I];
    pose proof Hk as (K1 & K2 & K3 & K4);
    (* what holds whatever the part comes to, but for | *)
    (assert (Same : match f with Beside _ _ => True | _ => forall v, held (enter f K) v = held K v end)
       by (destruct f; cbn; auto));
    (assert (Need : forall v, needed K v = true -> needed (enter f K) v = true)
       by (intros v Hv; destruct f; cbn; try (apply orb_true_iff; left; exact Hv); exact Hv));
    (assert (Common : match f with Beside _ _ => True | _ =>
        (forall v, held K v = true -> allocation S1 v = allocation S v) /\ incl (bound S1) (bound S) /\
        (forall v, In v (bound S) -> needed K v = true -> In v (bound S1)) end)
       by (destruct f; auto; (split; [intros v Hv; apply K1; rewrite Same; exact Hv | split; [exact K2 | auto]]))).
    - (* it goes on *)
      is_only Hin. destruct K4 as ([W' N' R'] & Hn & Hc).
      destruct f; cbn [plug replug] in *.
      + (* >> *)
        destruct Common as (C1 & C2 & C3). inversion W; subst.
        split; [exact C1 | split; [exact C2 | split; [exact C3 | split; [split|split]]]].
        * apply Wf_sequence; auto.
          -- eapply Wf_more; [exact W'|]. intros v _. unfold usable. cbn. rewrite app_nil_r. auto.
          -- eapply (rest_wf K S S1 _ t (In_sequence t)); eauto. intros v Hv. cbn. apply mem_or. auto.
        * intros v Hv. rewrite names_sequence. intros [Hr | Hr].
          -- apply (N' v Hv Hr).
          -- apply (N v Hv). cbn. apply in_app_iff. auto.
        * intros v Hv. unfold run_at. rewrite running_sequence. apply R'. exact Hv.
        * intros v. rewrite names_sequence. cbn [names]. rewrite in_app_iff. intros [Hv | Hv]; [|auto].
          destruct (Hn v Hv); auto.
        * intros v. rewrite recruits_sequence. cbn [recruits]. intros Hv. destruct (Hc v Hv) as [|[Hm Hb]]; auto.
          apply named_inside in Hm. tauto.
      + (* | *)
        inversion W as [| | | | |X rs Wrs Hap| | | | | | | | | | | | | | | | | |]; subst X rs.
        cbn [enter held needed named its_recruits frame_names] in *.
        assert (Hsib : forall q, In q (before ++ after) -> Wf (usable K (bound S1)) q).
        { intros q Hq. eapply (rest_wf K S S1 _ q (Beside before after)); eauto.
          - intros v Hv. cbn. apply mem_or. right. apply in_flat_map. eauto.
          - apply Wrs. rewrite in_app_iff in *. cbn. tauto. }
        assert (Hap' : apart (before ++ after)).
        { apply apart_app in Hap. destruct Hap as (A1 & [A2 A3] & A4). apply apart_app.
          split; [exact A1 | split; [exact A3|]]. intros v Hv Hv'. apply (A4 v Hv). cbn. apply in_app_iff. auto. }
        assert (Hdis : forall v, In v (names r') -> ~ In v (flat_map names (before ++ after))).
        { intros v Hv Hv'. apply (N' v); [apply mem_or; auto | exact Hv]. }
        assert (Hns : forall v, In v (names (Parallel (before ++ flat r' ++ after))) <->
                       In v (flat_map names (before ++ after)) \/ In v (names r')).
        { intros v. rewrite (through_splice _ _ _ _ _ through_names), flat_map_app, !in_app_iff. tauto. }
        split; [intros v Hv; apply K1; apply mem_or; auto | split; [exact K2 | split; [|split; [split|split]]]].
        * intros v Hv Hn'. apply K3; [exact Hv | apply mem_or; auto].
        * apply Wf_splice; auto.
          eapply Wf_more; [exact W'|]. intros v _. unfold usable. cbn [its_recruits enter]. rewrite app_nil_r. auto.
        * intros v Hv. rewrite Hns. intros [H | H].
          -- apply (N v Hv). cbn [names]. rewrite flat_map_app in *. cbn. rewrite !in_app_iff in *. tauto.
          -- apply (N' v); [apply mem_or; auto | exact H].
        * intros v Hv. unfold run_at. rewrite (through_splice _ _ _ _ _ through_running), !lookup_app.
          destruct (mem v (flat_map names (before ++ after))) eqn:M.
          -- (* a sibling's *)
             apply mem_spec in M. rewrite K1 by (apply mem_or; auto). rewrite R by exact Hv. unfold run_at.
             cbn [running]. rewrite flat_map_app. cbn [flat_map]. rewrite !lookup_app.
             assert (E1 : lookup v (running r) = None).
             { apply (run_at_not_named r v). intros Hr. apply apart_app in Hap. destruct Hap as (_ & [A2 _] & A4).
               rewrite flat_map_app, in_app_iff in M. destruct M as [M | M].
               - apply (A4 v M). cbn. apply in_app_iff. auto.
               - apply (A2 v Hr M). }
             assert (E2 : lookup v (running r') = None).
             { apply (run_at_not_named r' v). intros Hr. apply (Hdis v Hr M). }
             rewrite E1, E2. reflexivity.
          -- apply mem_false in M. rewrite R' by (apply mem_or_false; auto). unfold run_at.
             rewrite flat_map_app, in_app_iff in M.
             assert (Hb : lookup v (flat_map running before) = None).
             { apply lookup_none. rewrite map_flat_map. intros H. apply in_flat_map in H. destruct H as (q & Hq & H).
               apply M. left. apply in_flat_map. exists q. split; [exact Hq|]. apply running_named. exact H. }
             assert (Ha : lookup v (flat_map running after) = None).
             { apply lookup_none. rewrite map_flat_map. intros H. apply in_flat_map in H. destruct H as (q & Hq & H).
               apply M. right. apply in_flat_map. exists q. split; [exact Hq|]. apply running_named. exact H. }
             rewrite Hb, Ha. destruct (lookup v (running r')); reflexivity.
        * intros v. rewrite Hns. cbn [names]. rewrite !flat_map_app. cbn [flat_map]. rewrite !in_app_iff.
          intros [[H | H] | H]; auto. destruct (Hn v H) as [H' | H']; auto.
          apply mem_or_false in H'. tauto.
        * intros v. rewrite (through_splice _ _ _ _ _ through_recruits). cbn [recruits]. rewrite flat_map_app. cbn [flat_map].
          rewrite !in_app_iff. intros [H | [H | H]]; auto. destruct (Hc v H) as [H' | [Hm Hb]]; auto.
          apply mem_or_false in Hm. tauto.
      + (* allOf *)
        destruct Common as (C1 & C2 & C3). inversion W; subst.
        split; [exact C1 | split; [exact C2 | split; [exact C3 | split; [split|split]]]].
        * constructor; auto.
          -- eapply Wf_more; [exact W'|]. intros v _. unfold usable. cbn. rewrite app_nil_r. auto.
          -- intros b Hb. eapply (rest_wf K S S1 _ (snd b) (Branch_of bs)); eauto.
             intros v Hv. cbn. apply mem_or. right. apply in_flat_map. eauto.
        * intros v Hv. cbn. rewrite in_app_iff. intros [Hr | Hr].
          -- apply (N' v Hv Hr).
          -- apply (N v Hv). cbn. apply in_app_iff. auto.
        * exact R'.
        * intros v. cbn [names]. rewrite !in_app_iff. intros [Hv | Hv]; [|auto]. destruct (Hn v Hv); auto.
        * intros v Hv. destruct (Hc v Hv) as [|[Hm Hb]]; auto. apply named_inside in Hm. tauto.
      + (* until *)
        destruct Common as (C1 & C2 & C3).
        split; [exact C1 | split; [exact C2 | split; [exact C3 | split; [split|split]]]]; auto.
        * constructor. eapply Wf_more; [exact W'|]. intros v _. unfold usable. cbn. rewrite app_nil_r. auto.
        * intros v Hv. destruct (Hc v Hv) as [|[Hm Hb]]; auto. apply named_inside in Hm. tauto.
      + (* during *)
        destruct Common as (C1 & C2 & C3).
        split; [exact C1 | split; [exact C2 | split; [exact C3 | split; [split|split]]]]; auto.
        * constructor. eapply Wf_more; [exact W'|]. intros v _. unfold usable. cbn. rewrite app_nil_r. auto.
        * intros v Hv. destruct (Hc v Hv) as [|[Hm Hb]]; auto. apply named_inside in Hm. tauto.
      + (* watch *)
        destruct Common as (C1 & C2 & C3).
        split; [exact C1 | split; [exact C2 | split; [exact C3 | split; [split|split]]]]; auto.
        * constructor. eapply Wf_more; [exact W'|]. intros v _. unfold usable. cbn. rewrite app_nil_r. auto.
        * intros v Hv. destruct (Hc v Hv) as [|[Hm Hb]]; auto. apply named_inside in Hm. tauto.
      + (* repeat *)
        destruct Common as (C1 & C2 & C3). inversion W; subst.
        split; [exact C1 | split; [exact C2 | split; [exact C3 | split; [split|split]]]].
        * constructor; auto.
          -- eapply Wf_more; [exact W'|]. intros v _. unfold usable. cbn. rewrite app_nil_r. auto.
          -- eapply (rest_wf K S S1 _ t (Round_of more g t)); eauto. intros v Hv. cbn. apply mem_or. auto.
        * intros v Hv. cbn. rewrite in_app_iff. intros [Hr | Hr].
          -- apply (N' v Hv Hr).
          -- apply (N v Hv). cbn. apply in_app_iff. auto.
        * exact R'.
        * intros v. cbn [names]. rewrite !in_app_iff. intros [Hv | Hv]; [|auto]. destruct (Hn v Hv); auto.
        * intros v Hv. destruct (Hc v Hv) as [|[Hm Hb]]; auto. apply named_inside in Hm. tauto.
      + (* holding *)
        destruct Common as (C1 & C2 & C3). inversion W; subst.
        split; [exact C1 | split; [exact C2 | split; [exact C3 | split; [split|split]]]].
        * constructor. eapply Wf_more; [exact W'|]. intros v _. unfold usable. cbn. rewrite app_nil_r. auto.
        * intros v Hv. cbn. rewrite in_app_iff. intros [Hr | Hr].
          -- apply (N v Hv). cbn. apply in_app_iff. auto.
          -- apply (N' v Hv Hr).
        * exact R'.
        * intros v. cbn [names]. rewrite !in_app_iff. intros [Hv | Hv]; [auto|]. destruct (Hn v Hv); auto.
        * intros v Hv. destruct (Hc v Hv) as [|[Hm Hb]]; auto. apply named_inside in Hm. tauto.
      + (* recruited *)
        destruct Common as (C1 & C2 & C3). inversion W; subst.
        split; [exact C1 | split; [exact C2 | split; [exact C3 | split; [split|split]]]].
        * constructor.
          -- intros Hv. destruct (Hc v Hv) as [Hr | [Hm _]]; [auto|]. apply named_inside in Hm. cbn in Hm. tauto.
          -- eapply Wf_more; [exact W'|]. intros u _. unfold usable. cbn. rewrite in_app_iff. cbn. intuition.
        * intros u Hu [<- | Hr].
          -- apply (N v Hu). left. reflexivity.
          -- apply (N' u Hu Hr).
        * exact R'.
        * intros u [<- | Hu]; [left; left; reflexivity|]. destruct (Hn u Hu); [left; right|]; auto.
        * intros u [<- | Hu]; [left; left; reflexivity|]. destruct (Hc u Hu) as [|[Hm Hb]]; [left; right; auto|].
          apply named_inside in Hm. tauto.
      + (* fresh *)
        destruct Common as (C1 & C2 & C3).
        split; [exact C1 | split; [exact C2 | split; [exact C3 | split; [split|split]]]]; auto.
        * constructor. eapply Wf_more; [exact W'|]. intros v _. unfold usable. cbn. rewrite app_nil_r. auto.
        * intros v Hv. destruct (Hc v Hv) as [|[Hm Hb]]; auto. apply named_inside in Hm. tauto.
      + (* ensure *)
        destruct Common as (C1 & C2 & C3).
        split; [exact C1 | split; [exact C2 | split; [exact C3 | split; [split|split]]]]; auto.
        * constructor. eapply Wf_more; [exact W'|]. intros v _. unfold usable. cbn. rewrite app_nil_r. auto.
        * intros v Hv. destruct (Hc v Hv) as [|[Hm Hb]]; auto. apply named_inside in Hm. tauto.
    - (* it is done *)
      cbn [lift] in Hin. destruct Hin as [Hin | []]. subst t'.
      destruct f; cbn [plug on_ok] in *;
        try (destruct Common as (C1 & C2 & C3); split; [exact C1 | split; [exact C2 | split; [exact C3 | exact K4]]]; fail).
      + (* SEQ-2 *)
        destruct Common as (C1 & C2 & C3). inversion W; subst.
        split; [exact C1 | split; [exact C2 | split; [exact C3 | split; [|split]]]].
        * apply placed_quiet; auto.
          -- eapply (rest_wf K S S1 _ t (In_sequence t)); eauto. intros v Hv. cbn. apply mem_or. auto.
          -- intros v Hv Hin. apply (N v Hv). cbn. apply in_app_iff. auto.
        * intros v Hv. left. cbn. apply in_app_iff. auto.
        * intros v. rewrite quiet_recruits by assumption. intros [].
      + (* PAR-2 *)
        inversion W as [| | | | |X rs Wrs Hap| | | | | | | | | | | | | | | | | |]; subst X rs.
        cbn [enter held needed named its_recruits frame_names] in *.
        assert (Hsib : forall q, In q (before ++ after) -> Wf (usable K (bound S1)) q).
        { intros q Hq. eapply (rest_wf K S S1 _ q (Beside before after)); eauto.
          - intros v Hv. cbn. apply mem_or. right. apply in_flat_map. eauto.
          - apply Wrs. rewrite in_app_iff in *. cbn. tauto. }
        assert (Hap' : apart (before ++ after)).
        { apply apart_app in Hap. destruct Hap as (A1 & [A2 A3] & A4). apply apart_app.
          split; [exact A1 | split; [exact A3|]]. intros v Hv Hv'. apply (A4 v Hv). cbn. apply in_app_iff. auto. }
        split; [intros v Hv; apply K1; apply mem_or; auto | split; [exact K2 | split; [|split; [split|split]]]].
        * intros v Hv Hn'. apply K3; [exact Hv | apply mem_or; auto].
        * apply Wf_parallel; assumption.
        * intros v Hv. rewrite (through_parallel _ _ _ through_names). intros H. apply (N v Hv).
          cbn [names]. rewrite flat_map_app in *. cbn. rewrite !in_app_iff in *. tauto.
        * intros v Hv. unfold run_at. rewrite (through_parallel _ _ _ through_running), flat_map_app, lookup_app.
          destruct (mem v (flat_map names (before ++ after))) eqn:M.
          -- apply mem_spec in M. rewrite K1 by (apply mem_or; auto). rewrite R by exact Hv. unfold run_at.
             cbn [running]. rewrite flat_map_app. cbn [flat_map]. rewrite !lookup_app.
             assert (E1 : lookup v (running r) = None).
             { apply (run_at_not_named r v). intros Hr. apply apart_app in Hap. destruct Hap as (_ & [A2 _] & A4).
               rewrite flat_map_app, in_app_iff in M. destruct M as [M | M].
               - apply (A4 v M). cbn. apply in_app_iff. auto.
               - apply (A2 v Hr M). }
             rewrite E1. reflexivity.
          -- apply mem_false in M. rewrite K4 by (apply mem_or_false; auto). rewrite flat_map_app, in_app_iff in M.
             assert (Hb : lookup v (flat_map running before) = None).
             { apply lookup_none. rewrite map_flat_map. intros H. apply in_flat_map in H. destruct H as (q & Hq & H).
               apply M. left. apply in_flat_map. exists q. split; [exact Hq|]. apply running_named. exact H. }
             assert (Ha : lookup v (flat_map running after) = None).
             { apply lookup_none. rewrite map_flat_map. intros H. apply in_flat_map in H. destruct H as (q & Hq & H).
               apply M. right. apply in_flat_map. exists q. split; [exact Hq|]. apply running_named. exact H. }
             rewrite Hb, Ha. reflexivity.
        * intros v. rewrite (through_parallel _ _ _ through_names). cbn [names]. rewrite !flat_map_app. cbn [flat_map].
          rewrite !in_app_iff. tauto.
        * intros v. rewrite (through_parallel _ _ _ through_recruits). cbn [recruits]. rewrite !flat_map_app. cbn [flat_map].
          rewrite !in_app_iff. tauto.
      + (* ALLOF-2 *)
        destruct Common as (C1 & C2 & C3). inversion W; subst.
        split; [exact C1 | split; [exact C2 | split; [exact C3 | split; [split|split]]]].
        * apply Wf_all_of; auto. intros b Hb. eapply (rest_wf K S S1 _ (snd b) (Branch_of bs)); eauto.
          intros v Hv. cbn. apply mem_or. right. apply in_flat_map. eauto.
        * intros v Hv. rewrite names_all_of. intros Hin. apply (N v Hv). cbn. apply in_app_iff. auto.
        * intros v Hv. unfold run_at. rewrite running_all_of. apply K4. exact Hv.
        * intros v. rewrite names_all_of. intros Hv. left. cbn. apply in_app_iff. auto.
        * intros v. rewrite recruits_all_of. intros [].
      + (* REPEAT-2 *)
        destruct Common as (C1 & C2 & C3). inversion W; subst.
        assert (Wt : Wf (usable K (bound S1)) t).
        { eapply (rest_wf K S S1 _ t (Round_of more g t)); eauto. intros v Hv. cbn. apply mem_or. auto. }
        destruct g as [g|].
        * split; [exact C1 | split; [exact C2 | split; [exact C3 | split; [split|split]]]].
          -- constructor; auto.
          -- intros v Hv Hin. apply (N v Hv). cbn in *. apply in_app_iff. auto.
          -- intros v Hv. apply K4. exact Hv.
          -- intros v Hv. left. cbn in *. apply in_app_iff. auto.
          -- intros v [].
        * split; [exact C1 | split; [exact C2 | split; [exact C3 | split; [split|split]]]].
          -- apply Wf_repeat; auto.
          -- intros v Hv Hin. apply names_repeat in Hin. apply (N v Hv). cbn. apply in_app_iff. tauto.
          -- intros v Hv. unfold run_at. rewrite running_repeat, quiet_running by assumption. apply K4. exact Hv.
          -- intros v Hin. apply names_repeat in Hin. left. cbn. apply in_app_iff. tauto.
          -- intros v. rewrite recruits_repeat, quiet_recruits by assumption. intros [].
    - (* it fails *)
      destruct f; cbn [plug lift on_err] in *;
        try (is_only Hin; destruct Common as (C1 & C2 & C3);
             split; [exact C1 | split; [exact C2 | split; [exact C3 | exact K4]]]; fail).
      + (* PAR-ERR *)
        is_only Hin.
        cbn [enter held needed named its_recruits frame_names] in *.
        assert (Hrun : forall v, In v (flat_map run_of (before ++ after)) -> In v (flat_map names (before ++ after))).
        { intros v Hv. apply in_flat_map in Hv. destruct Hv as (q & Hq & Hv). apply in_flat_map. exists q.
          split; [exact Hq|]. apply running_named. exact Hv. }
        assert (Hout : forall v, held K v = true -> ~ In v (flat_map names (before ++ after))).
        { intros v Hv H. apply (N v Hv). cbn [names]. rewrite flat_map_app in *. cbn. rewrite !in_app_iff in *. tauto. }
        split; [|split; [exact K2 | split; [|]]].
        * intros v Hv. cbn [does allocation]. rewrite without_spec.
          destruct (mem v (flat_map run_of (before ++ after))) eqn:M.
          -- apply mem_spec, Hrun in M. exfalso. apply (Hout v Hv M).
          -- apply K1. apply mem_or. auto.
        * intros v Hv Hn'. apply K3; [exact Hv | apply mem_or; auto].
        * intros v Hv. cbn [does allocation]. rewrite without_spec.
          destruct (mem v (flat_map run_of (before ++ after))) eqn:M; [reflexivity|].
          apply mem_false in M. destruct (mem v (flat_map names (before ++ after))) eqn:M'.
          -- (* a sibling names it, but does not run it; nor did the part *)
             apply mem_spec in M'. rewrite K1 by (apply mem_or; auto). rewrite R by exact Hv.
             inversion W as [| | | | |X rs Wrs Hap| | | | | | | | | | | | | | | | | |]; subst X rs.
             unfold run_at. cbn [plug running]. apply lookup_none. rewrite map_flat_map. intros H. apply in_flat_map in H. destruct H as (q & Hq & H).
             apply in_app_iff in Hq. cbn in Hq. destruct Hq as [Hq | [<- | Hq]].
             ++ apply M. apply in_flat_map. exists q. split; [apply in_app_iff; auto | exact H].
             ++ apply running_named in H. apply apart_app in Hap. destruct Hap as (_ & [A2 _] & A4).
                rewrite flat_map_app, in_app_iff in M'. destruct M' as [M' | M'].
                ** apply (A4 v M'). cbn. apply in_app_iff. auto.
                ** apply (A2 v H M').
             ++ apply M. apply in_flat_map. exists q. split; [apply in_app_iff; auto | exact H].
          -- apply mem_false in M'. apply K4. apply mem_or_false. auto.
      + (* a handler *)
        unfold on_error in Hin.
        destruct (handles_error (handles h) m K S1) as [x s gone N0 ds | m' ds | m' ds | m' s gone N0 ds |] eqn:Hh;
          try contradiction.
        * assert (Done : forall o,
            match o with Next r' => running r' = [] /\ names r' = [] /\ recruits r' = [] /\ forall X, Wf X r' | _ => True end ->
            kept K S (Watch r h) (By l (after_handler s gone N0 S1) o (E ++ effects_of ds))).
          { intros o Ho. eapply handler_kept; eauto. }
          destruct x as [ | | | t].
          -- is_only Hin. apply Done. exact I.
          -- is_only Hin. apply Done. exact I.
          -- destruct (anew h) as [(t & q)|]; is_only Hin; apply Done; auto.
             repeat split; try reflexivity. intros X. constructor. constructor.
          -- destruct (anew h) as [(u & q)|].
             ++ destruct (deepest <=? depth q); is_only Hin; apply Done; auto.
                repeat split; try reflexivity. intros X. constructor.
             ++ is_only Hin. apply Done. exact I.
        * is_only Hin. destruct Common as (C1 & C2 & C3).
          split; [exact C1 | split; [exact C2 | split; [exact C3 | exact K4]]].
        * is_only Hin. exact I.
        * is_only Hin. exact I.
  Qed.
  Lemma goes_kept e K S r t : sound K -> placed K S r -> goes e K S r t -> kept K S r t.
  Proof.
    intros HK HP H. induction H as [K S r t H | K S f r t t' _ IH Hl].
    - eapply own_kept; eauto.
    - eapply lift_kept; eauto. apply IH; [apply sound_enter; exact HK | apply placed_inside; exact HP].
  Qed.

  (** Every step of every part keeps A, B and the residual in order. *)
  Theorem steps_keep_order e K S r l S' o E :
    sound K -> placed K S r -> step e K S r l S' o E -> kept K S r (By l S' o E).
  Proof. intros HK HP H. eapply goes_kept; eauto. apply goes_iff_step. exact H. Qed.

  (** After a cut, an error or an end, nothing of the part runs. *)
  Theorem nothing_runs_after e K S r l S' o E :
    sound K -> placed K S r -> step e K S r l S' o E -> (o = Ok \/ exists m, o = Err m) ->
    forall v, held K v = false -> allocation S' v = None.
  Proof.
    intros HK HP H Ho. pose proof (steps_keep_order _ _ _ _ _ _ _ _ HK HP H) as Hk.
    destruct Ho as [-> | [m ->]]; cbn in Hk; apply Hk.
  Qed.

  (** Nothing of a held vehicle is given away: a step of a part neither changes what runs on it nor names it. *)
  Theorem held_is_not_given e K S r l S' r' E :
    sound K -> placed K S r -> step e K S r l S' (Next r') E ->
    forall v, held K v = true -> allocation S' v = allocation S v /\ ~ In v (names r').
  Proof.
    intros HK HP H v Hv. destruct (steps_keep_order _ _ _ _ _ _ _ _ HK HP H) as (H1 & _ & _ & [_ N _] & _ & _). auto.
  Qed.

  (** {1 Of configurations} *)

  Definition in_order (c : configuration) : Prop :=
    let S := shared_of c in
    NoDup (bound S) /\
    match control_of c with
    | Exec _ r =>
        Wf (fun v => In v (bound S)) r /\ (forall v, allocation S v = run_at r v) /\
        (forall v, In v (recruits r) -> ~ In v (bound S))
    | Script _ | Wait _ _ => forall v, allocation S v = None
    | End _ => (forall v, allocation S v = None) /\ bound S = []
    end.

  Definition initial (M : machine) (s : store) (N : tuples) : configuration :=
    {| control_of := Script M; shared_of := {| variables := s; allocation := nothing; bound := []; space := N |} |}.

  Theorem initially_in_order M s N : in_order (initial M s N).
  Proof. split; [constructor | intros v; reflexivity]. Qed.

  Lemma placed_alone w S r :
    Wf (fun v => In v (bound S)) r -> (forall v, allocation S v = run_at r v) -> placed (alone w) S r.
  Proof.
    intros W R. split.
    - eapply Wf_more; [exact W|]. unfold usable. auto.
    - intros v Hv. discriminate.
    - intros v _. apply R.
  Qed.

  Lemma NoDup_minus vs ws : NoDup vs -> NoDup (minus vs ws).
  Proof. apply NoDup_filter. Qed.

  Lemma NoDup_app (vs ws : list vehicle) :
    NoDup vs -> NoDup ws -> (forall v, In v ws -> ~ In v vs) -> NoDup (vs ++ ws).
  Proof.
    intros H1 H2 H3. induction vs as [|v vs IH]; [exact H2|]. inversion H1; subst. cbn. constructor.
    - rewrite in_app_iff. intros [H | H]; [auto|]. apply (H3 v H). left. reflexivity.
    - apply IH; auto. intros u Hu Hu'. apply (H3 u Hu). right. exact Hu'.
  Qed.

  Lemma Sub_NoDup X (V xs : list X) : Sub V xs -> NoDup xs -> NoDup V.
  Proof.
    induction 1 as [| x V xs Hs IH | x V xs Hs IH]; intros Hn; [constructor | |]; inversion Hn; subst; auto.
    constructor; auto. intros Hx. apply (Sub_incl _ _ _ Hs) in Hx. contradiction.
  Qed.

  (** A step of the task never puts a vehicle into B. *)
  Lemma step_bound e K S r l S' o E :
    step e K S r l S' o E -> exists ws, bound S' = minus (bound S) ws.
  Proof.
    assert (Same : forall vs : list vehicle, exists ws, vs = minus vs ws).
    { intros vs. exists []. unfold minus. symmetry. rewrite <- (filter_ext (fun _ => true)).
      - induction vs; cbn; congruence.
      - intros v. reflexivity. }
    assert (Two : forall (vs : list vehicle) ws us, exists xs, minus (minus vs ws) us = minus vs xs).
    { intros vs ws us. exists (ws ++ us). unfold minus. induction vs as [|v vs IH]; [reflexivity|]. cbn.
      destruct (mem v ws) eqn:M1; cbn.
      - replace (mem v (ws ++ us)) with true; [exact IH|]. symmetry. apply mem_spec. apply in_app_iff.
        left. apply mem_spec. exact M1.
      - destruct (mem v us) eqn:M2; cbn.
        + replace (mem v (ws ++ us)) with true; [exact IH|]. symmetry. apply mem_spec. apply in_app_iff.
          right. apply mem_spec. exact M2.
        + replace (mem v (ws ++ us)) with false; [cbn; rewrite IH; reflexivity|]. symmetry. apply mem_false.
          rewrite in_app_iff, <- !mem_spec. intros [H | H]; congruence. }
    induction 1; try (apply Same; fail); try assumption; try (apply (Same (bound S)); fail);
      destruct IHstep as [ws IH];
      try (exists ws; exact IH);
      match goal with
      | IH : bound ?T = minus (bound ?U) _ |- exists xs, bound (after_handler _ ?gone _ ?T) = _ =>
          change (exists xs, minus (bound T) gone = minus (bound U) xs); rewrite IH; apply Two
      end.
  Qed.

  Theorem invariant_is_inductive w e c l c' E : cstep w e c l c' E -> in_order c -> in_order c'.
  Proof.
    intros H. destruct H; intros [HB HI]; cbn [control_of shared_of script_at waits_at executes ended] in *;
      try (split; [exact HB | exact HI]; fail);
      try (split; [constructor | split; [intros v; reflexivity | reflexivity]]; fail).
    - (* RELEASE *) split; [apply NoDup_minus; exact HB | exact HI].
    - (* PICK-BIND *)
      split; [|exact HI]. cbn. apply NoDup_app; [exact HB | eapply Sub_NoDup; [eassumption | apply fit_once_law]|].
      intros v Hv. apply (Sub_incl _ _ _ H) in Hv. eapply fit_law. exact Hv.
    - (* PICK-BIND, of all *)
      split; [|exact HI]. cbn [with_bound bound]. rewrite <- H0.
      apply NoDup_app; [exact HB | apply fit_once_law|]. intros u Hu. eapply fit_law. exact Hu.
    - (* EXECUTE *)
      apply alloc_built in H0. destruct H0 as (W & Q & N). split; [exact HB|].
      split; [exact W | split].
      + intros v. cbn. rewrite HI. symmetry. apply quiet_runs_nothing. exact Q.
      + intros v. rewrite quiet_recruits by exact Q. intros [].
    - (* EXECUTE-DONE *)
      destruct HI as (W & R & C'). pose proof (steps_keep_order _ _ _ _ _ _ _ _ (sound_alone w) (placed_alone w _ _ W R) H) as Hk.
      destruct Hk as (_ & _ & _ & Hn). split.
      + destruct (step_bound _ _ _ _ _ _ _ _ H) as [ws Hws]. change (NoDup (bound S')). rewrite Hws.
        apply NoDup_minus. exact HB.
      + intros v. apply Hn. reflexivity.
    - (* a step of the task *)
      destruct HI as (W & R & C'). pose proof (steps_keep_order _ _ _ _ _ _ _ _ (sound_alone w) (placed_alone w _ _ W R) H) as Hk.
      destruct Hk as (_ & Hincl & _ & [W' _ R'] & _ & Hc). split; [|split; [|split]].
      + destruct (step_bound _ _ _ _ _ _ _ _ H) as [ws Hws]. change (NoDup (bound S')). rewrite Hws.
        apply NoDup_minus. exact HB.
      + eapply Wf_more; [exact W'|]. intros v _ [Hv | []]. exact Hv.
      + intros v. apply R'. reflexivity.
      + intros v Hv Hb. apply Hincl in Hb. destruct (Hc v Hv) as [Hr | [_ Hr]]; [apply (C' v Hr Hb) | auto].
    - (* ON-INTERRUPT *)
      split; [|intros v; reflexivity]. change (NoDup (bound S ++ recruited_by k)). unfold recruited_by, residual_of.
      destruct k as [M0 | M0 q | M0 r | x]; cbn [recruits flat_map]; rewrite ?app_nil_r; try exact HB.
      destruct HI as (W & R & C'). apply NoDup_app; [exact HB | apply (Wf_nodup _ _ W) | exact C'].
  Qed.

  Inductive reachable (M : machine) (s : store) (N : tuples) : configuration -> Prop :=
  | At_first : reachable M s N (initial M s N)
  | By_step : forall w e c l c' E, reachable M s N c -> cstep w e c l c' E -> reachable M s N c'.

  Theorem always_in_order M s N c : reachable M s N c -> in_order c.
  Proof. induction 1; [apply initially_in_order | eapply invariant_is_inductive; eauto]. Qed.

  Lemma lookup_unique l v p : NoDup (map fst l) -> In (v, p) l -> lookup v l = Some p.
  Proof.
    induction l as [|(w, q) l IH]; cbn; [intros _ []|]. intros Hn [H | H].
    - injection H as -> ->. destruct (vehicle_eq v v); [reflexivity | congruence].
    - inversion Hn; subst. destruct (vehicle_eq v w) as [->|]; [|auto].
      exfalso. apply H2. apply in_map_iff. exists (w, p). auto.
  Qed.

  (** [Configuration.invariant], of every configuration that a program comes to. *)
  Theorem configuration_invariant M s N c :
    reachable M s N c ->
    let S := shared_of c in
    let r := residual_of (control_of c) in
    (* A's vehicles are in B, or recruited; none is both, and none is there twice *)
    (forall v p, allocation S v = Some p -> In v (bound S) \/ In v (recruits r)) /\
    (forall v, In v (recruits r) -> ~ In v (bound S)) /\ NoDup (bound S) /\ NoDup (recruits r) /\
    (* A is exactly what runs, and no vehicle runs two tasks *)
    (forall v p, allocation S v = Some p <-> In (v, p) (running r)) /\ NoDup (run_of r) /\
    (* no vehicle is named on both sides of a | *)
    (exists X, Wf X r) /\
    (* after the end A and B are empty *)
    (forall x, control_of c = End x -> bound S = [] /\ forall v, allocation S v = None).
  Proof.
    intros H. apply always_in_order in H. destruct c as [k S]. destruct H as [HB HI].
    cbn [control_of shared_of] in *.
    assert (Here : (forall v, allocation S v = None) -> residual_of k = Parallel [] ->
      (forall v p, allocation S v = Some p -> In v (bound S) \/ In v (recruits (residual_of k))) /\
      (forall v, In v (recruits (residual_of k)) -> ~ In v (bound S)) /\
      NoDup (bound S) /\ NoDup (recruits (residual_of k)) /\
      (forall v p, allocation S v = Some p <-> In (v, p) (running (residual_of k))) /\ NoDup (run_of (residual_of k)) /\
      (exists X, Wf X (residual_of k))).
    { intros HA ->. cbn. split; [intros v p; rewrite HA; discriminate|]. split; [intros v []|].
      split; [exact HB|]. split; [constructor|]. split; [|split; [constructor|]].
      - intros v p. rewrite HA. split; [discriminate | intros []].
      - exists (fun _ => False). constructor; [intros r [] | exact I]. }
    destruct k as [M' | M' q | M' r | x].
    - destruct (Here HI eq_refl) as (? & ? & ? & ? & ? & ? & ?).
      repeat (split; [assumption|]). discriminate.
    - destruct (Here HI eq_refl) as (? & ? & ? & ? & ? & ? & ?).
      repeat (split; [assumption|]). discriminate.
    - destruct HI as (W & R & Hc). destruct (Wf_nodup _ _ W) as [N1 N2]. cbn [residual_of].
      assert (HA : forall v p, allocation S v = Some p <-> In (v, p) (running r)).
      { intros v p. rewrite R. split; [apply lookup_in | apply lookup_unique; exact N1]. }
      split; [|split; [exact Hc | split; [exact HB | split; [exact N2 | split; [exact HA | split; [exact N1 |
        split; [eauto | discriminate]]]]]]].
      intros v p Hv. apply HA in Hv. apply (Wf_running _ _ v W). unfold run_of. apply in_map_iff. exists (v, p). auto.
    - destruct HI as [HA Hb]. destruct (Here HA eq_refl) as (? & ? & ? & ? & ? & ? & ?).
      repeat (split; [assumption|]). exact HA.
  Qed.
End Invariants.
