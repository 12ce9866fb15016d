(** Each transition is a sequence of events of spec/Abstract.tla, as spec/DolphinRefinement.tla states it: first the
    event from outside, then the deeds of code, then the requests to the outside, in their order; and the end last. *)
From Dolphin Require Export Abstract Once.
From Coq Require Import Permutation.

Section Events.
  Context {L : Names}.

  (** {1 The events of a transition} *)

  Definition releases (ds : list deed) : list vehicle :=
    flat_map (fun d => match d with Released vs => vs | _ => [] end) ds.

  Definition of_effect (x : effect) : list abstract_event :=
    match x with
    | Start p v => [AStart v p]
    | Stop v => [AStop v]
    | Bind vs => map ABind vs
    | Release vs => map ARelease vs
    | _ => []
    end.

  Definition of_event (x : option event) : list abstract_event :=
    match x with Some (Done v) | Some (Failure v _) => [AEnd v] | _ => [] end.

  (** Pairs are normal in N: values that [==] holds of are one. *)
  Definition of_deeds (normal_pair : pair_of -> pair_of) (ds : list deed) : list abstract_event :=
    flat_map (fun d => match d with
      | Posted ks => map (fun x => APost (normal_pair x)) ks
      | Consumed ks => map (fun x => AConsume (normal_pair x)) ks
      | _ => []
      end) ds.

  (** What events of pairs make of a bag. *)
  Inductive bag_run : list abstract_event -> list pair_of -> list pair_of -> Prop :=
  | Bag_nil : forall n n', Permutation n n' -> bag_run [] n n'
  | Bag_post : forall x es n n1 n', Permutation n1 (x :: n) -> bag_run es n1 n' -> bag_run (APost x :: es) n n'
  | Bag_consume : forall x es n n1 n', Permutation n (x :: n1) -> bag_run es n1 n' -> bag_run (AConsume x :: es) n n'.

  Lemma bag_run_same es n n1 n' : Permutation n n1 -> bag_run es n1 n' -> bag_run es n n'.
  Proof.
    intros P H. destruct H as [n1 n' H | x es n1 n2 n' H R | x es n1 n2 n' H R].
    - constructor. eapply Permutation_trans; eassumption.
    - eapply Bag_post; [|exact R]. eapply Permutation_trans; [exact H|]. apply perm_skip, Permutation_sym, P.
    - eapply Bag_consume; [|exact R]. eapply Permutation_trans; eassumption.
  Qed.

  Lemma bag_run_app es es' n n1 n' : bag_run es n n1 -> bag_run es' n1 n' -> bag_run (es ++ es') n n'.
  Proof.
    induction 1 as [n n1 P | x es n n2 n1 P R IH | x es n n2 n1 P R IH]; intros H; cbn.
    - eapply bag_run_same; eassumption.
    - eapply Bag_post; [exact P | apply IH; exact H].
    - eapply Bag_consume; [exact P | apply IH; exact H].
  Qed.

  Lemma bag_happens es : forall n n' s, bag_run es n n' -> Permutation (bag s) n -> over s = false ->
    exists s', happen es s s' /\ same_tasks s s' /\ same_held s s' /\ Permutation (bag s') n' /\ over s' = false.
  Proof.
    induction es as [|e es IH]; intros n n' s H P Ho.
    - inversion H; subst. exists s. split; [constructor; apply same_refl|].
      split; [intros v; reflexivity | split; [intros v; reflexivity | split; [|exact Ho]]].
      eapply Permutation_trans; eassumption.
    - assert (G : forall n1, (forall s1, bag s1 = n1 -> same_tasks s s1 -> same_held s s1 -> over s1 = false ->
          happens e s s1) -> bag_run es n1 n' ->
        exists s', happen (e :: es) s s' /\ same_tasks s s' /\ same_held s s' /\ Permutation (bag s') n' /\
          over s' = false).
      { intros n1 Hs R. pose (s1 := {| tasks := tasks s; holds := holds s; bag := n1; over := false |}).
        destruct (IH n1 n' s1 R) as (s' & H1 & H2 & H3 & H4 & H5); [apply Permutation_refl | reflexivity|].
        exists s'. split; [econstructor; [apply Hs | exact H1]; try reflexivity; intros v; reflexivity|].
        split; [intros v; rewrite (H2 v); reflexivity | split; [intros v; rewrite (H3 v); reflexivity | auto]]. }
      inversion H; subst; eapply G; try eassumption; intros s1 Hb HA HB Ho1;
        (split; [exact Ho|]; split; [|auto]); rewrite Hb.
      + eapply Permutation_trans; [eassumption|]. apply perm_skip, Permutation_sym, P.
      + eapply Permutation_trans; eassumption.
  Qed.
End Events.

(** What the refinement asks of code and of N, beside [Code]. *)
Class Deeds {L : Names} {C : Code} := {
  pairs : tuples -> list pair_of;
  normal_pair : pair_of -> pair_of;
  post_law : forall ks N, bag_run (of_deeds normal_pair [Posted ks]) (pairs N) (pairs (post ks N));
  take_law : forall ks N N', take ks N = Some N' -> bag_run (of_deeds normal_pair [Consumed ks]) (pairs N) (pairs N');
  forget_events_law : forall ks N, exists xs, bag_run (of_deeds normal_pair [Consumed xs]) (pairs N)
    (pairs (forget ks N));
  forget_all_events_law : forall N, exists xs, bag_run (of_deeds normal_pair [Consumed xs]) (pairs N)
    (pairs (forget_all N));
  (** Code changes N by its deeds alone, and releases no vehicle; a handler releases those of B that it dismisses. *)
  gives_law : forall c ys w held S x s N ds, run c ys w held S = Gives x s N ds ->
    releases ds = [] /\ bag_run (of_deeds normal_pair ds) (pairs (space S)) (pairs N);
  halts_law : forall c ys w held S m s N ds, run c ys w held S = Halts m s N ds ->
    releases ds = [] /\ bag_run (of_deeds normal_pair ds) (pairs (space S)) (pairs N);
  rules_law : forall h m w held needed S x s gone N ds, run_handler h m w held needed S = Rules x s gone N ds ->
    NoDup (releases ds) /\ (forall v, In v (releases ds) <-> In v gone /\ In v (bound S)) /\
    bag_run (of_deeds normal_pair ds) (pairs (space S)) (pairs N);
  halted_law : forall h m w held needed S y s gone N ds, run_handler h m w held needed S = Halts_ y s gone N ds ->
    NoDup (releases ds) /\ (forall v, In v (releases ds) <-> In v gone /\ In v (bound S)) /\
    (forall v, In v gone -> needed v = false) /\
    bag_run (of_deeds normal_pair ds) (pairs (space S)) (pairs N)
}.

Section Refinement.
  Context {L : Names} {C : Code} {D : Deeds}.

  (** {1 The events of one vehicle} *)

  Definition proj (v : vehicle) (E : list effect) : list vehicle_event :=
    flat_map (of_vehicle v) (flat_map of_effect E).
  Definition proj_event (v : vehicle) (x : option event) : list vehicle_event :=
    flat_map (of_vehicle v) (of_event x).

  Lemma proj_app v a b : proj v (a ++ b) = proj v a ++ proj v b.
  Proof. unfold proj. rewrite !flat_map_app. reflexivity. Qed.

  Lemma of_map (v : vehicle) (e : vehicle -> abstract_event) (y : vehicle_event) vs :
    (forall u, of_vehicle v (e u) = if vehicle_eq u v then [y] else []) -> NoDup vs ->
    flat_map (of_vehicle v) (map e vs) = if mem v vs then [y] else [].
  Proof.
    intros He. induction vs as [|u vs IH]; intros Hn; [reflexivity|]. inversion Hn; subst. cbn [map flat_map].
    rewrite He, IH by assumption. destruct (vehicle_eq u v) as [->|N].
    - rewrite (proj2 (mem_false v vs)) by assumption. rewrite (proj2 (mem_spec v (v :: vs))) by (left; reflexivity).
      reflexivity.
    - destruct (mem v vs) eqn:M.
      + apply mem_spec in M. rewrite (proj2 (mem_spec v (u :: vs))) by (right; exact M). reflexivity.
      + apply mem_false in M. rewrite (proj2 (mem_false v (u :: vs))); [reflexivity|].
        intros [H | H]; [congruence | auto].
  Qed.

  Lemma proj_stops v vs : NoDup vs -> proj v (map Stop vs) = if mem v vs then [VEnd] else [].
  Proof.
    intros H. rewrite <- (of_map v AStop VEnd vs); [|reflexivity | exact H]. unfold proj. f_equal.
    clear H. induction vs as [|u vs IH]; [reflexivity|]. cbn. rewrite IH. reflexivity.
  Qed.

  Lemma proj_release v vs : NoDup vs -> proj v (release vs) = if mem v vs then [VRelease] else [].
  Proof.
    intros H. rewrite <- (of_map v ARelease VRelease vs); [|reflexivity | exact H].
    unfold proj. destruct vs; [reflexivity|]. cbn [release flat_map of_effect]. rewrite app_nil_r. reflexivity.
  Qed.

  Lemma proj_bind v vs : NoDup vs -> proj v [Bind vs] = if mem v vs then [VBind] else [].
  Proof.
    intros H. rewrite <- (of_map v ABind VBind vs); [|reflexivity | exact H].
    unfold proj. cbn [flat_map of_effect]. rewrite app_nil_r. reflexivity.
  Qed.

  Lemma proj_effects v ds : proj v (effects_of ds) = flat_map (of_vehicle v) (map ARelease (releases ds)).
  Proof.
    unfold proj, effects_of, releases. induction ds as [|d ds IH]; [reflexivity|]. cbn [flat_map].
    rewrite map_app, !flat_map_app, IH. f_equal.
    destruct d; cbn; rewrite ?app_nil_r; reflexivity.
  Qed.

  Lemma proj_deeds v ds : NoDup (releases ds) ->
    proj v (effects_of ds) = if mem v (releases ds) then [VRelease] else [].
  Proof. intros H. rewrite proj_effects. apply of_map; [reflexivity | exact H]. Qed.

  Lemma proj_none v ds : releases ds = [] -> proj v (effects_of ds) = [].
  Proof. intros H. rewrite proj_effects, H. reflexivity. Qed.

  Lemma releases_said ds : releases (said ds) = [].
  Proof. unfold releases, said. induction ds as [|d ds IH]; [reflexivity|]. destruct d; cbn; exact IH. Qed.

  Lemma proj_said v ds : proj v (effects_of (said ds)) = [].
  Proof. apply proj_none, releases_said. Qed.

  Lemma proj_begun v r : proj v (begun r) = [].
  Proof. unfold proj, begun. induction (waits r) as [|[i []] ws IH]; [reflexivity | exact IH | exact IH]. Qed.

  Lemma proj_ceases v ws : proj v (map ceases ws) = [].
  Proof. unfold proj. induction ws as [|[i []] ws IH]; [reflexivity | exact IH | exact IH]. Qed.

  Lemma left_app a b : left_alone (a ++ b) = left_alone a ++ left_alone b.
  Proof. apply flat_map_app. Qed.

  Lemma left_effects ds : left_alone (effects_of ds) = releases ds.
  Proof.
    unfold left_alone, effects_of, releases. induction ds as [|d ds IH]; [reflexivity|]. cbn [flat_map].
    rewrite flat_map_app, IH. f_equal. destruct d; cbn; rewrite ?app_nil_r; reflexivity.
  Qed.

  Lemma left_begun r : left_alone (begun r) = [].
  Proof. unfold left_alone, begun. induction (waits r) as [|[i []] ws IH]; [reflexivity | exact IH | exact IH]. Qed.

  Lemma left_cut rs : left_alone (cut rs) = flat_map recruits rs.
  Proof.
    unfold cut. rewrite !left_app. unfold left_alone.
    assert (H1 : flat_map (fun x => match x with Release vs => vs | _ => [] end) (map ceases (flat_map waits rs)) = []).
    { induction (flat_map waits rs) as [|[i []] ws IH]; [reflexivity | exact IH | exact IH]. }
    assert (H2 : flat_map (fun x => match x with Release vs => vs | _ => [] end) (map Stop (flat_map run_of rs)) = []).
    { induction (flat_map run_of rs) as [|u ws IH]; [reflexivity | exact IH]. }
    rewrite H1, H2. cbn [app]. destruct (flat_map recruits rs); [reflexivity|]. cbn. rewrite app_nil_r. reflexivity.
  Qed.

  Lemma mem_same v a b : (In v a <-> In v b) -> mem v a = mem v b.
  Proof.
    intros H. destruct (mem v a) eqn:M; symmetry; [apply mem_spec, H, mem_spec, M | apply mem_false].
    apply mem_false in M. tauto.
  Qed.

  (** Plans are stopped, then vehicles released. *)
  Lemma stop_release v vs rs a h :
    NoDup vs -> NoDup rs -> (In v vs -> a <> None /\ h = true) ->
    (In v rs -> h = true /\ (In v vs \/ a = None)) ->
    vrun (proj v (map Stop vs ++ release rs)) (st a h) =
      Some (st (if mem v vs then None else a) (if mem v rs then false else h)).
  Proof.
    intros Hv Hr H1 H2. rewrite proj_app, (proj_stops v vs Hv), (proj_release v rs Hr).
    destruct (mem v vs) eqn:M.
    - apply mem_spec in M. destruct (H1 M) as [Ha ->]. destruct a as [p|]; [|congruence].
      destruct (mem v rs); reflexivity.
    - apply mem_false in M. destruct (mem v rs) eqn:M'; [|reflexivity].
      apply mem_spec in M'. destruct (H2 M') as [-> [H | ->]]; [contradiction | reflexivity].
  Qed.

  Lemma cut_run rs v a h :
    NoDup (flat_map run_of rs) -> NoDup (flat_map recruits rs) ->
    (In v (flat_map run_of rs) -> a <> None /\ h = true) ->
    (In v (flat_map recruits rs) -> h = true /\ (In v (flat_map run_of rs) \/ a = None)) ->
    vrun (proj v (cut rs)) (st a h) =
      Some (st (if mem v (flat_map run_of rs) then None else a) (if mem v (flat_map recruits rs) then false else h)).
  Proof.
    intros H1 H2 H3 H4. unfold cut. rewrite proj_app, proj_ceases. apply stop_release; assumption.
  Qed.

  (** {1 Steps of parts} *)

  (** A part holds B, its recruits, and the vehicles [X] that were recruited around it or beside it. *)
  Definition here (X : vehicle -> bool) (S : shared) (cs : list vehicle) (v : vehicle) : bool :=
    mem v (bound S) || mem v cs || X v.

  Definition rest (r : residual) (o : outcome) (E : list effect) : list vehicle :=
    match o with Next r' => recruits r' | Ok | Err _ => [] | Ends _ => minus (recruits r) (left_alone E) end.

  Record beside (X : vehicle -> bool) (K : context) (S : shared) (r : residual) : Prop := {
    b_recruits : forall v, In v (its_recruits K) -> X v = true;
    b_named : forall v, X v = true -> named K v = true;
    b_bound : forall v, X v = true -> ~ In v (bound S);
    b_own : forall v, X v = true -> ~ In v (recruits r);
    b_apart : forall v, In v (recruits r) -> ~ In v (bound S)
  }.

  Definition fits (x : option event) (X : vehicle -> bool) (K : context) (S : shared) (r : residual) (t : transition)
    : Prop :=
    match t with
    | By l S' o E =>
        (forall v, vrun (proj_event v x ++ proj v E) (st (allocation S v) (here X S (recruits r) v)) =
                   Some (st (allocation S' v) (here X S' (rest r o E) v))) /\
        (forall v, X v = true -> ~ In v (left_alone E)) /\
        match o with
        | Ends _ =>
            (forall v, held K v = false -> allocation S' v <> None -> here X S' (rest r o E) v = true) /\
            (forall v, In v (bound S) -> needed K v = true -> In v (bound S'))
        | _ => True
        end
    end.

  Ltac is_only H := cbn in H; destruct H as [H | H]; [subst | contradiction].

  (** A step that changes neither A nor B, to a part with as many recruits. *)
  Lemma fits_still x X K S r l S' o E :
    (forall v, proj_event v x = []) -> (forall v, proj v E = []) -> left_alone E = [] ->
    allocation S' = allocation S -> bound S' = bound S -> rest r o E = recruits r ->
    match o with Ends _ => False | _ => True end ->
    fits x X K S r (By l S' o E).
  Proof.
    intros Hx HE Hl HA HB Hr Ho. split; [|split].
    - intros v. rewrite Hx, HE, HA, Hr. unfold here. rewrite HB. reflexivity.
    - intros v _. rewrite Hl. intros [].
    - destruct o; auto. contradiction.
  Qed.

  Lemma running_here X K S r v : placed K S r -> beside X K S r -> held K v = false -> allocation S v <> None ->
    here X S (recruits r) v = true.
  Proof.
    intros [W N R] HB Hh Ha. rewrite R in Ha by exact Hh.
    assert (Hv : In v (run_of r)).
    { destruct (in_dec vehicle_eq v (run_of r)) as [H | H]; [exact H|]. exfalso. apply Ha.
      apply lookup_none. exact H. }
    unfold here. rewrite !orb_true_iff, !mem_spec. destruct (Wf_running _ _ v W Hv) as [[H | H] | H]; auto.
    right. apply (b_recruits _ _ _ _ HB). exact H.
  Qed.

  Lemma fits_ends x X K S r l S' y E :
    placed K S r -> beside X K S r ->
    (forall v, proj_event v x = []) -> (forall v, proj v E = []) -> left_alone E = [] ->
    allocation S' = allocation S -> bound S' = bound S -> fits x X K S r (By l S' (Ends y) E).
  Proof.
    intros HP Hb Hx HE Hl HA HB.
    assert (Hr : forall v, here X S' (rest r (Ends y) E) v = here X S (recruits r) v).
    { intros v. unfold here, rest. rewrite HB, Hl. f_equal. f_equal. apply mem_same. rewrite in_minus. cbn. tauto. }
    split; [|split; [|split]].
    - intros v. rewrite Hx, HE, HA, Hr. reflexivity.
    - intros v _. rewrite Hl. intros [].
    - intros v Hv Ha. rewrite Hr. rewrite HA in Ha. eapply running_here; eassumption.
    - intros v Hv _. rewrite HB. exact Hv.
  Qed.

  Lemma coded_fits e X K S r c ys gives faulty t :
    placed K S r -> beside X K S r -> In t (coded e c ys K S gives faulty) ->
    (forall x s N ds, e = None -> releases ds = [] -> In t (gives x s N ds) -> fits e X K S r t) ->
    (forall m ds, e = None -> In t (faulty m ds) -> fits e X K S r t) -> fits e X K S r t.
  Proof.
    unfold coded, runs. intros HP Hb H Hg Hf. destruct e; [contradiction|].
    destruct (run c ys (world_of K) (held K) S) as [x s N ds | m ds | m ds | m s N ds |] eqn:R; try contradiction.
    - eapply Hg; [reflexivity | apply (gives_law _ _ _ _ _ _ _ _ _ R) | exact H].
    - eapply Hf; [reflexivity | exact H].
    - is_only H. apply fits_ends; auto; [intros v; apply proj_said | rewrite left_effects; apply releases_said].
    - is_only H. destruct (halts_law _ _ _ _ _ _ _ _ _ R) as [Hr _].
      apply fits_ends; auto; [intros v; apply proj_none; exact Hr | rewrite left_effects; exact Hr].
  Qed.

  Lemma guarded_fits e X K S r g holds fails faulty t :
    placed K S r -> beside X K S r -> In t (guarded e g K S holds fails faulty) ->
    (forall s N ds, e = None -> releases ds = [] -> In t (holds s N ds) -> fits e X K S r t) ->
    (e = None -> In t fails -> fits e X K S r t) ->
    (forall m ds, e = None -> In t (faulty m ds) -> fits e X K S r t) -> fits e X K S r t.
  Proof.
    unfold guarded. intros HP Hb H Hh Hn Hf. eapply coded_fits; [exact HP | exact Hb | exact H | |]; cbv beta.
    - intros x s N ds He Hr Hin. destruct (truth x) as [[]|]; eauto; contradiction.
    - intros m ds He Hin. destruct (is_unknown m); [contradiction | eauto].
  Qed.

  (** A cut of all that a part runs. *)
  Lemma fits_cut x X K S r l S0 o E0 whole :
    placed K S r -> beside X K S r -> recruits whole = recruits r ->
    (forall v, proj_event v x = []) -> (forall v, proj v E0 = []) -> left_alone E0 = [] ->
    allocation S0 = allocation S -> bound S0 = bound S ->
    match o with Ok | Err _ => True | _ => False end ->
    fits x X K S whole (By l (does (ensured r) (without (run_of r) S0)) o (E0 ++ cut [r])).
  Proof.
    intros HP Hb Hw Hx HE Hl HA HB Ho. pose proof HP as [W N R]. destruct (Wf_nodup _ _ W) as [N1 N2].
    assert (F1 : flat_map run_of [r] = run_of r) by (cbn; apply app_nil_r).
    assert (F2 : flat_map recruits [r] = recruits r) by (cbn; apply app_nil_r).
    split; [|split].
    - intros v. rewrite Hx, proj_app, HE. cbn [app]. rewrite Hw.
      rewrite cut_run; rewrite ?F1, ?F2; auto.
      + f_equal. f_equal; [|].
        * cbn. rewrite HA. reflexivity.
        * assert (Hr : rest whole o (E0 ++ cut [r]) = []) by (destruct o; try contradiction; reflexivity).
          rewrite Hr. unfold here. cbn [mem does without with_allocation bound]. rewrite HB.
          destruct (mem v (recruits r)) eqn:M.
          -- apply mem_spec in M. symmetry. rewrite !orb_false_iff. repeat split.
             ++ apply mem_false. apply (b_apart _ _ _ _ Hb). exact M.
             ++ destruct (X v) eqn:Xv; [|reflexivity]. exfalso. apply (b_own _ _ _ _ Hb v Xv M).
          -- rewrite orb_false_r. destruct (mem v (bound S)); reflexivity.
      + intros Hv. assert (Hh : held K v = false).
        { destruct (held K v) eqn:Hh; [|reflexivity]. exfalso. apply (N v Hh). apply running_named. exact Hv. }
        assert (Ha : allocation S v <> None).
        { rewrite R by exact Hh. intros H. apply lookup_none in H. contradiction. }
        split; [exact Ha | eapply running_here; eassumption].
      + intros Hv. split; [unfold here; rewrite (proj2 (mem_spec v _) Hv); rewrite orb_true_r; reflexivity|].
        assert (Hh : held K v = false).
        { destruct (held K v) eqn:Hh; [|reflexivity]. exfalso. apply (N v Hh). apply recruits_named. exact Hv. }
        rewrite R by exact Hh. destruct (in_dec vehicle_eq v (run_of r)) as [H | H]; [auto|].
        right. apply lookup_none. exact H.
    - intros v Xv. rewrite left_app, Hl, left_cut, F2. apply (b_own _ _ _ _ Hb). exact Xv.
    - destruct o; try contradiction; exact I.
  Qed.

  Lemma own_fits e X K S r t : sound K -> placed K S r -> beside X K S r -> In t (own e K S r) -> fits e X K S r t.
  Proof.
    intros HK HP Hb Ht. pose proof HP as [W N R].
    destruct r; cbn [own] in Ht; try contradiction.
    - (* START *)
      destruct e; [contradiction|]. is_only Ht. inversion W; subst.
      assert (Hv : held K v = false).
      { destruct (held K v) eqn:Hv; [|reflexivity]. exfalso. apply (N v Hv). left. reflexivity. }
      split; [|split; [intros u _ [] | exact I]]. intros u. cbn [app proj_event of_event flat_map].
      change (proj u [Start p v]) with ((if vehicle_eq v u then [VStart p] else []) ++ []). rewrite app_nil_r.
      cbn [start_on with_allocation allocation].
      assert (Hh : here X (start_on v p S) (rest (Ready p v) (Next (Running p v)) [Start p v]) u =
                   here X S (recruits (Ready p v)) u) by reflexivity.
      rewrite Hh. destruct (vehicle_eq v u) as [<-|Nu].
      + rewrite (R v Hv). destruct (vehicle_eq v v); [|congruence]. cbn [run_at running lookup].
        assert (Hu : here X S (recruits (Ready p v)) v = true).
        { unfold here. rewrite !orb_true_iff, mem_spec. destruct H1 as [H1 | H1]; [auto|].
          right. apply (b_recruits _ _ _ _ Hb). exact H1. }
        rewrite Hu. reflexivity.
      + destruct (vehicle_eq u v); [congruence|]. reflexivity.
    - (* DONE, FAIL *)
      assert (Hv : held K v = false).
      { destruct (held K v) eqn:Hv; [|reflexivity]. exfalso. apply (N v Hv). left. reflexivity. }
      assert (Hu : here X S [] v = true).
      { apply (running_here X K S (Running p v)); auto. rewrite R by exact Hv. unfold run_at. cbn.
        destruct (vehicle_eq v v); congruence. }
      assert (G : forall u, vrun ((if vehicle_eq v u then [VEnd] else []) ++ [])
                    (st (allocation S u) (here X S [] u)) =
                  Some (st (allocation (without [v] S) u) (here X (without [v] S) [] u))).
      { intros u. rewrite app_nil_r. rewrite without_spec.
        change (here X (without [v] S) [] u) with (here X S [] u).
        destruct (vehicle_eq v u) as [<-|Nu].
        - rewrite (proj2 (mem_spec v [v])) by (left; reflexivity). rewrite (R v Hv), Hu. unfold run_at. cbn.
          destruct (vehicle_eq v v); [reflexivity | congruence].
        - rewrite (proj2 (mem_false u [v])); [reflexivity|]. intros [H | []]. congruence. }
      destruct e as [[]|]; try contradiction; destruct (vehicle_eq v0 v) as [->|]; try contradiction; is_only Ht;
        (split; [intros u; unfold proj_event; cbn [of_event flat_map]; rewrite app_nil_r; apply G
                | split; [intros u _ [] | exact I]]).
    - eapply coded_fits; [exact HP | exact Hb | exact Ht | |]; cbv beta.
      + intros x s N0 ds -> Hr H. is_only H. apply fits_still; auto; [intros v; apply proj_none; exact Hr|].
        rewrite left_effects. exact Hr.
      + intros m ds -> H. is_only H. apply fits_still; auto; [intros v; apply proj_said|].
        rewrite left_effects. apply releases_said.
    - eapply guarded_fits; [exact HP | exact Hb | exact Ht | | |]; cbv beta.
      + intros s N0 ds -> Hr H. is_only H. apply fits_still; auto; [intros v; apply proj_none; exact Hr|].
        rewrite left_effects. exact Hr.
      + intros _ [].
      + intros m ds -> H. is_only H. apply fits_still; auto; [intros v; apply proj_said|].
        rewrite left_effects. apply releases_said.
    - (* ALLOF-WHEN *)
      apply in_each in Ht. destruct Ht as (b & (g & r) & after & Hbs & Ht). cbn [app] in Ht.
      inversion W as [| | | | | | |X0 bs' Wb Qb| | | | | | | | | | | | | | | |]; subst X0 bs'.
      destruct (branches_split _ _ _ _ _ _ Hbs Wb Qb) as (Wr & Qr & _). unfold choose in Ht. cbn [fst snd] in Ht.
      eapply guarded_fits; [exact HP | exact Hb | exact Ht | | |]; cbv beta.
      + intros s N0 ds -> Hr H. is_only H. destruct (given_same ds r) as (_ & _ & G3 & _ & _).
        apply fits_still; auto.
        * intros v. rewrite proj_app, proj_begun, (proj_none v ds Hr). reflexivity.
        * rewrite left_app, left_begun, left_effects, Hr. reflexivity.
        * cbn [rest]. rewrite recruits_branch_of, G3, quiet_recruits by exact Qr. reflexivity.
      + intros _ [].
      + intros m ds -> H. is_only H. apply fits_still; auto; [intros v; apply proj_said|].
        rewrite left_effects. apply releases_said.
    - (* ONEOF-WHEN *)
      apply in_each in Ht. destruct Ht as (b & (g & r) & after & Hbs & Ht). cbn [app] in Ht.
      inversion W as [| | | | | | | |X0 bs' Wb Qb| | | | | | | | | | | | | | |]; subst X0 bs'.
      destruct (branches_split _ _ _ _ _ _ Hbs Wb Qb) as (Wr & Qr & _). unfold choose in Ht. cbn [fst snd] in Ht.
      eapply guarded_fits; [exact HP | exact Hb | exact Ht | | |]; cbv beta.
      + intros s N0 ds -> Hr H. is_only H. destruct (given_same ds r) as (_ & _ & G3 & _ & _).
        apply fits_still; auto.
        * intros v. rewrite proj_app, proj_begun, (proj_none v ds Hr). reflexivity.
        * rewrite left_app, left_begun, left_effects, Hr. reflexivity.
        * cbn [rest]. rewrite G3, quiet_recruits by exact Qr. reflexivity.
      + intros _ [].
      + intros m ds -> H. is_only H. apply fits_still; auto; [intros v; apply proj_said|].
        rewrite left_effects. apply releases_said.
    - (* UNTIL-CUT, ASSURE-CUT *)
      assert (HP' : placed K S r) by (split; auto; inversion W; assumption).
      assert (Hb' : beside X K S r) by (destruct Hb; split; auto).
      eapply guarded_fits; [exact HP | exact Hb | exact Ht | | |]; cbv beta.
      + intros s N0 ds -> Hr H. destruct k; [is_only H | contradiction].
        apply fits_cut; auto; [intros v; apply proj_none; exact Hr|]. rewrite left_effects. exact Hr.
      + intros -> H. destruct k; [contradiction | is_only H].
        apply (fits_cut None X K S r _ S _ [] (Until (Fails at_site) g r)); auto.
      + intros m ds -> H. is_only H. apply fits_cut; auto; [intros v; apply proj_said|].
        rewrite left_effects. apply releases_said.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction]. is_only Ht.
      apply fits_still; auto.
    - destruct e as [[]|]; try contradiction.
      + destruct yes; (destruct (timer_eq i0 i); [|contradiction]); is_only Ht; apply fits_still; auto.
      + destruct (timer_eq i0 i); [|contradiction]. is_only Ht. apply fits_still; auto.
    - (* DURING-CUT, WITHIN-CUT *)
      assert (HP' : placed K S r) by (split; auto; inversion W; assumption).
      assert (Hb' : beside X K S r) by (destruct Hb; split; auto).
      destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction]. is_only Ht.
      apply (fits_cut (Some (Expired i)) X K S r _ S _ [] (During k i n r)); auto. destruct k; exact I.
    - (* DURING-SET *)
      inversion W; subst.
      eapply coded_fits; [exact HP | exact Hb | exact Ht | |]; cbv beta.
      + intros x s N0 ds -> Hr H. destruct (time_of d x) as [n|m]; is_only H; apply fits_still; auto.
        * intros v. rewrite proj_app, (proj_none v ds Hr). apply (proj_begun v r).
        * rewrite left_app, left_effects, Hr. apply (left_begun r).
        * cbn. apply quiet_recruits. assumption.
        * intros v. apply proj_said.
        * rewrite left_effects. apply releases_said.
      + intros m ds -> H. is_only H. apply fits_still; auto; [intros v; apply proj_said|].
        rewrite left_effects. apply releases_said.
    - (* REPEAT-UNTIL, REPEAT-AGAIN *)
      inversion W; subst.
      eapply guarded_fits; [exact HP | exact Hb | exact Ht | | |]; cbv beta.
      + intros s N0 ds -> Hr H. is_only H. apply fits_still; auto; [intros v; apply proj_none; exact Hr|].
        rewrite left_effects. exact Hr.
      + intros -> H. is_only H. apply fits_still; auto; [intros v; apply proj_begun | apply left_begun|].
        cbn [rest]. rewrite recruits_repeat, quiet_recruits by assumption. reflexivity.
      + intros m ds -> H. is_only H. apply fits_still; auto; [intros v; apply proj_said|].
        rewrite left_effects. apply releases_said.
    - (* MAKE *)
      eapply coded_fits; [exact HP | exact Hb | exact Ht | |]; cbv beta.
      + intros x s N0 ds -> Hr H. destruct (made_task a ys q S x s ds); is_only H; apply fits_still; auto.
      + intros m ds -> H. is_only H. apply fits_still; auto; [intros v; apply proj_said|].
        rewrite left_effects. apply releases_said.
    - (* ALLOCATE *)
      destruct e; [contradiction|].
      destruct (alloc_made (world_of K) (held K) S (free K S) t0 q (taken_numbers K)) as [(vs & r) | m] eqn:A.
      + is_only Ht. apply alloc_made_built in A. destruct A as (Wr & Qr & _ & _).
        apply fits_still; auto; [intros v; apply proj_begun | apply left_begun|].
        assert (Hr : recruits (holding vs r) = recruits r) by (destruct vs; reflexivity).
        cbn [rest]. rewrite Hr, quiet_recruits by exact Qr. reflexivity.
      + destruct (alloc_made (world_of K) (held K) S (its_bound K S) t0 q (taken_numbers K)); [contradiction|].
        is_only Ht. apply fits_still; auto.
    - (* RECRUIT *)
      destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction].
      destruct (mem v (fit q (world_of K) (bound S))) eqn:M; [|contradiction]. apply mem_spec, fit_law in M.
      destruct (named K v) eqn:Nm; cbn in Ht; [contradiction|]. is_only Ht.
      assert (Hv : held K v = false).
      { destruct (held K v) eqn:Hv; [|reflexivity]. apply held_needed, needed_named in Hv; auto; congruence. }
      split; [|split; [intros u _ [] | exact I]]. intros u. cbn [proj_event of_event flat_map app].
      rewrite (proj_bind u [v]) by (constructor; [intros [] | constructor]).
      cbn [rest recruits]. destruct (mem u [v]) eqn:Mu.
      + apply mem_spec in Mu. destruct Mu as [<- | []]. rewrite (R v Hv). unfold run_at. cbn [running lookup].
        unfold here. rewrite (proj2 (mem_false v (bound S)) M). cbn [orb].
        assert (Xv : X v = false).
        { destruct (X v) eqn:Xv; [|reflexivity]. apply (b_named _ _ _ _ Hb) in Xv. congruence. }
        rewrite Xv, (proj2 (mem_spec v [v])) by (left; reflexivity). reflexivity.
      + unfold here. rewrite Mu. reflexivity.
  Qed.

  (** {1 Steps of a part, in the whole} *)

  Definition frame_recruits (f : frame) : list vehicle :=
    match f with Beside before after => flat_map recruits (before ++ after) | In_recruited v => [v] | _ => [] end.

  Definition around (f : frame) (X : vehicle -> bool) (v : vehicle) : bool := X v || mem v (frame_recruits f).

  Lemma recruits_plug f r v :
    In v (recruits (plug f r)) <-> In v (frame_recruits f) \/ In v (recruits r).
  Proof.
    destruct f; cbn [plug recruits frame_recruits]; cbn; try tauto.
    rewrite !flat_map_app. cbn. rewrite !in_app_iff. tauto.
  Qed.

  Lemma recruits_replug f r v :
    In v (recruits (replug f r)) <-> In v (frame_recruits f) \/ In v (recruits r).
  Proof.
    destruct f; cbn [replug]; try (rewrite <- recruits_plug; reflexivity).
    - rewrite recruits_sequence. cbn. tauto.
    - rewrite (through_splice _ _ _ _ _ through_recruits). cbn [frame_recruits]. rewrite flat_map_app, !in_app_iff. tauto.
  Qed.

  Lemma mem_app v a b : mem v (a ++ b) = mem v a || mem v b.
  Proof.
    destruct (mem v (a ++ b)) eqn:M; symmetry.
    - apply mem_spec, in_app_iff in M. rewrite orb_true_iff, !mem_spec. exact M.
    - apply mem_false in M. rewrite in_app_iff in M. rewrite orb_false_iff, !mem_false. tauto.
  Qed.

  (** What the frame has recruited counts for the part as recruited around it. *)
  Lemma here_around f X S cs whole v :
    (In v whole <-> In v (frame_recruits f) \/ In v cs) -> here X S whole v = here (around f X) S cs v.
  Proof.
    intros H. unfold here, around. rewrite (mem_same v whole (frame_recruits f ++ cs)) by (rewrite in_app_iff; exact H).
    rewrite mem_app. destruct (mem v (bound S)), (mem v (frame_recruits f)), (mem v cs), (X v); reflexivity.
  Qed.

  Lemma NoDup_middle (a b c : list vehicle) v : NoDup (a ++ b ++ c) -> In v (a ++ c) -> ~ In v b.
  Proof.
    intros Hn Hac Hb. apply in_app_iff in Hac. destruct Hac as [Ha | Hc].
    - apply in_split in Ha. destruct Ha as (a1 & a2 & ->). rewrite <- app_assoc in Hn. cbn in Hn.
      apply NoDup_remove_2 in Hn. apply Hn. rewrite !in_app_iff. auto.
    - apply in_split in Hb. destruct Hb as (b1 & b2 & ->). rewrite <- app_assoc, app_assoc in Hn. cbn in Hn.
      apply NoDup_remove_2 in Hn. apply Hn. rewrite !in_app_iff. auto.
  Qed.

  Lemma frame_apart X f r : Wf X (plug f r) -> forall v, In v (frame_recruits f) -> ~ In v (recruits r).
  Proof.
    intros W v Hv. destruct (Wf_nodup _ _ W) as [_ Hn]. destruct f; cbn [frame_recruits] in Hv; try contradiction.
    - cbn [plug recruits] in Hn. rewrite flat_map_app in *. cbn [flat_map] in Hn. eapply NoDup_middle; eassumption.
    - destruct Hv as [<- | []]. cbn in Hn. inversion Hn; assumption.
  Qed.

  Lemma beside_inside X K S f r :
    placed K S (plug f r) -> beside X K S (plug f r) -> beside (around f X) (enter f K) S r.
  Proof.
    intros [W N R] [B1 B2 B3 B4 B5]. unfold around. split.
    - intros v. cbn [enter its_recruits]. rewrite in_app_iff, orb_true_iff, mem_spec. intros [H | H]; [auto|].
      right. destruct f; try contradiction. exact H.
    - intros v. cbn [enter named]. rewrite !orb_true_iff, !mem_spec. intros [H | H]; [auto|]. right.
      destruct f; cbn [frame_recruits frame_names] in *; try contradiction; auto.
      apply in_flat_map in H. destruct H as (q & Hq & H). apply in_flat_map. exists q. split; [exact Hq|].
      apply recruits_named. exact H.
    - intros v. rewrite orb_true_iff, mem_spec. intros [H | H]; [auto|]. apply B5, recruits_plug. auto.
    - intros v. rewrite orb_true_iff, mem_spec. intros [H | H] Hv.
      + apply (B4 v H), recruits_plug. auto.
      + eapply frame_apart; eassumption.
    - intros v Hv. apply B5, recruits_plug. auto.
  Qed.

  Lemma vrun_out es : forall s, vrun es s = Some Out -> s <> Out -> In VRelease es.
  Proof.
    induction es as [|e es IH]; intros s H Hs; cbn in H.
    - congruence.
    - destruct (vstep s e) as [s1|] eqn:E1; [|discriminate].
      destruct s, e; cbn in E1; try discriminate; injection E1 as <-; cbn; auto; right; eapply IH; try eassumption;
        discriminate.
  Qed.

  Lemma release_left v E : In VRelease (proj v E) -> In v (left_alone E).
  Proof.
    unfold proj, left_alone. rewrite !in_flat_map. intros (e & He & Hv). apply in_flat_map in He.
    destruct He as (x & Hx & He). destruct e; cbn in Hv; try contradiction;
      try (destruct (vehicle_eq v0 v); [destruct Hv as [Hv | []]; discriminate | contradiction]).
    destruct (vehicle_eq v0 v) as [->|]; [|contradiction]. exists x. split; [exact Hx|].
    destruct x; cbn in He; try contradiction; try (destruct He as [He | []]; discriminate);
      apply in_map_iff in He; destruct He as (u & E0 & Hu); try discriminate. injection E0 as ->. exact Hu.
  Qed.

  Lemma event_no_release v x : ~ In VRelease (proj_event v x).
  Proof.
    unfold proj_event. destruct x as [[]|]; cbn; try tauto; rewrite app_nil_r; destruct (vehicle_eq v0 v); cbn;
      intuition discriminate.
  Qed.

  (** A part that is over has released what it had recruited. *)
  Lemma over_released x X K S r l S' o E :
    placed K S r -> beside X K S r -> kept K S r (By l S' o E) -> fits x X K S r (By l S' o E) ->
    match o with Ok | Err _ => True | _ => False end ->
    forall v, In v (recruits r) -> In v (left_alone E).
  Proof.
    intros [W N R] [B1 B2 B3 B4 B5] Hk [Hf _] Ho v Hv. specialize (Hf v).
    assert (Hh : held K v = false).
    { destruct (held K v) eqn:Hh; [|reflexivity]. exfalso. apply (N v Hh). apply recruits_named. exact Hv. }
    assert (Ha : allocation S' v = None /\ incl (bound S') (bound S)).
    { destruct o; try contradiction; destruct Hk as (_ & K2 & _ & K4); split; auto. }
    destruct Ha as [Ha Hi].
    assert (Hr : rest r o E = []) by (destruct o; try contradiction; reflexivity).
    assert (Xv : X v = false).
    { destruct (X v) eqn:Xv; [|reflexivity]. exfalso. apply (B4 v Xv Hv). }
    assert (Hb : mem v (bound S') = false) by (apply mem_false; intros H; apply (B5 v Hv), Hi, H).
    rewrite Ha, Hr in Hf. unfold here in Hf at 2. rewrite Hb, Xv in Hf. cbn [mem orb st] in Hf.
    apply vrun_out in Hf.
    - apply in_app_iff in Hf. destruct Hf as [H | H]; [destruct (event_no_release _ _ H) | apply release_left; exact H].
    - unfold here. rewrite (proj2 (mem_spec v (recruits r)) Hv), orb_true_r. cbn. destruct (allocation S v); discriminate.
  Qed.

  (** A handler gives up the vehicles that it dismisses. *)
  Lemma handler_fits x X K S r h l S1 m E s gone N0 ds o :
    sound K -> placed K S (Watch r h) -> beside X K S (Watch r h) ->
    kept (enter (In_watch h) K) S r (By l S1 (Err m) E) ->
    fits x (around (In_watch h) X) (enter (In_watch h) K) S r (By l S1 (Err m) E) ->
    NoDup (releases ds) -> (forall v, In v (releases ds) <-> In v gone /\ In v (bound S1)) ->
    (forall v, In v gone -> needed K v = false) ->
    (forall v, In v (rest (Watch r h) o (E ++ effects_of ds)) -> False) ->
    fits x X K S (Watch r h) (By l (after_handler s gone N0 S1) o (E ++ effects_of ds)).
  Proof.
    intros HK HP [B1 B2 B3 B4 B5] (K1 & K2 & K3 & K4) (F1 & F2 & _) Hn Hr Hg Hrest.
    cbn [enter held needed] in *.
    assert (Hx : forall v, X v = true -> ~ In v (bound S1)) by (intros v Xv Hv; apply (B3 v Xv), K2, Hv).
    split; [|split].
    - intros v. rewrite proj_app, app_assoc, vrun_app, (proj_deeds v ds Hn).
      assert (F := F1 v). rewrite <- (here_around (In_watch h) X S (recruits r) (recruits (Watch r h)) v) in F
        by (cbn; tauto).
      rewrite F. clear F. cbn [rest].
      assert (E0 : here (around (In_watch h) X) S1 [] v = mem v (bound S1) || X v).
      { unfold here, around. cbn [frame_recruits]. cbn [mem]. destruct (mem v (bound S1)), (X v); reflexivity. }
      rewrite E0.
      assert (E1 : here X (after_handler s gone N0 S1) (rest (Watch r h) o (E ++ effects_of ds)) v =
                   mem v (minus (bound S1) gone) || X v).
      { unfold here. cbn [after_handler with_bound bound].
        rewrite (proj2 (mem_false v (rest (Watch r h) o (E ++ effects_of ds)))) by (intros H; apply (Hrest v H)).
        rewrite orb_false_r. reflexivity. }
      rewrite E1. cbn [after_handler with_bound with_code allocation].
      destruct (mem v (releases ds)) eqn:M.
      + apply mem_spec, Hr in M. destruct M as [M1 M2].
        assert (Ha : allocation S1 v = None).
        { apply K4. cbn. destruct (held K v) eqn:Hh; [|reflexivity]. apply (held_needed _ HK) in Hh.
          rewrite (Hg v M1) in Hh. discriminate. }
        assert (Xv : X v = false).
        { destruct (X v) eqn:Xv; [|reflexivity]. destruct (Hx v Xv M2). }
        rewrite Ha, (proj2 (mem_spec v _) M2), Xv. cbn.
        rewrite (proj2 (mem_false v (minus (bound S1) gone))); [reflexivity|]. rewrite in_minus. tauto.
      + apply mem_false in M. cbn [vrun]. f_equal. f_equal. f_equal. apply mem_same. rewrite in_minus.
        rewrite Hr in M. tauto.
    - intros v Xv. rewrite left_app, left_effects, in_app_iff. intros [H | H].
      + apply (F2 v); [unfold around; rewrite Xv; reflexivity | exact H].
      + apply Hr in H. apply (Hx v Xv). tauto.
    - destruct o; auto. split.
      + intros v Hh Ha. exfalso. apply Ha. cbn [after_handler with_bound with_code allocation]. apply K4. exact Hh.
      + intros v Hv Hne. cbn [after_handler with_bound bound]. apply in_minus. split.
        * apply K3; [exact Hv|]. cbn. rewrite Hne. reflexivity.
        * intros H. rewrite (Hg v H) in Hne. discriminate.
  Qed.

  (** A recruited vehicle leaves when its task is over. *)
  Lemma leaving_fits x X K S v r l S1 o E :
    placed K S (Recruited v r) -> beside X K S (Recruited v r) ->
    incl (bound S1) (bound S) -> nothing_runs (enter (In_recruited v) K) S1 ->
    fits x (around (In_recruited v) X) (enter (In_recruited v) K) S r (By l S1 o E) ->
    match o with Ok | Err _ => True | _ => False end ->
    fits x X K S (Recruited v r) (By l S1 o (E ++ [Release [v]])).
  Proof.
    intros [W N R] [B1 B2 B3 B4 B5] K2 K4 (F1 & F2 & _) Ho.
    assert (Before : forall u, here X S (recruits (Recruited v r)) u =
                               here (around (In_recruited v) X) S (recruits r) u).
    { intros u. apply here_around, (recruits_plug (In_recruited v)). }
    assert (Rest : forall E0, rest r o E0 = [] /\ rest (Recruited v r) o E0 = [])
      by (intros E0; destruct o; try contradiction; auto).
    split; [|split; [|destruct o; auto; contradiction]].
    - intros u. rewrite proj_app, app_assoc, vrun_app, Before, F1. destruct (Rest E) as [-> _].
      destruct (Rest (E ++ [Release [v]])) as [_ ->]. change [Release [v]] with (release [v]).
      rewrite (proj_release u [v]) by (constructor; [intros [] | constructor]).
      unfold here, around. cbn [frame_recruits mem]. destruct (mem u [v]) eqn:M.
      + apply mem_spec in M. destruct M as [<- | []].
        assert (Hv : ~ In v (bound S1)) by (intros H; apply (B5 v (or_introl eq_refl)), K2, H).
        assert (Ha : allocation S1 v = None).
        { apply K4. cbn. destruct (held K v) eqn:Hh; [|reflexivity]. exfalso. apply (N v Hh). left. reflexivity. }
        assert (Xv : X v = false).
        { destruct (X v) eqn:Xv; [|reflexivity]. exfalso. apply (B4 v Xv). left. reflexivity. }
        rewrite Ha, (proj2 (mem_false v _) Hv), Xv. reflexivity.
      + cbn [vrun]. rewrite !orb_false_r. reflexivity.
    - intros u Xu. rewrite left_app, in_app_iff. cbn. intros [H | [<- | []]].
      + apply (F2 u); [unfold around; rewrite Xu; reflexivity | exact H].
      + apply (B4 v Xu). left. reflexivity.
  Qed.

  Lemma lift_fits f x X K S r t t' :
    sound K -> placed K S (plug f r) -> beside X K S (plug f r) -> kept (enter f K) S r t ->
    fits x (around f X) (enter f K) S r t -> loses x S t -> In t' (lift f K t) -> fits x X K S (plug f r) t'.
  Proof.
    intros HK HP Hb Hk Hf Hlo Hin. pose proof HP as [W N R]. pose proof Hb as [B1 B2 B3 B4 B5].
    pose proof (placed_inside _ _ _ _ HP) as HP'. pose proof (beside_inside _ _ _ _ _ HP Hb) as Hb'.
    assert (HX : forall v, X v = true -> around f X v = true) by (intros v Xv; unfold around; rewrite Xv; reflexivity).
    destruct t as [l S1 o E]. pose proof Hf as (F1 & F2 & F3).
    assert (Before : forall v, here X S (recruits (plug f r)) v = here (around f X) S (recruits r) v).
    { intros v. apply here_around, recruits_plug. }
    (* steps after which the frame's recruits are what is left *)
    assert (Plain : forall o' E', (forall v, proj v E' = []) -> left_alone E' = [] ->
      match o with Ends _ => False | _ => True end -> match o' with Ends _ => False | _ => True end ->
      (forall v, In v (rest (plug f r) o' (E ++ E')) <-> In v (frame_recruits f) \/ In v (rest r o E)) ->
      fits x X K S (plug f r) (By l S1 o' (E ++ E'))).
    { intros o' E' HE Hl Ho Ho' Hr. split; [|split].
      - intros v. rewrite proj_app, HE, app_nil_r, Before, F1. f_equal. f_equal. symmetry. apply here_around. apply Hr.
      - intros v Xv. rewrite left_app, Hl, app_nil_r. apply F2. auto.
      - destruct o'; auto. contradiction. }
    destruct o as [r' | | m | y].
    - (* it goes on *)
      is_only Hin. rewrite <- (app_nil_r E). apply Plain; auto. intros v. cbn [rest]. apply recruits_replug.
    - (* it is done *)
      cbn [lift] in Hin. destruct Hin as [Hin | []]. subst t'.
      assert (Over := over_released _ _ _ _ _ _ _ _ _ HP' Hb' Hk Hf I).
      destruct Hk as (_ & K2 & _ & K4).
      destruct f; cbn [plug on_ok] in *; try (rewrite <- (app_nil_r E); apply Plain; auto; cbn; tauto).
      + (* SEQ-2 *)
        apply Plain; auto; [intros v; apply proj_begun | apply left_begun|]. intros v. cbn [rest frame_recruits].
        inversion W; subst. rewrite quiet_recruits by assumption. tauto.
      + (* PAR-2 *)
        rewrite <- (app_nil_r E). apply Plain; auto. intros v. cbn [rest frame_recruits].
        rewrite (through_parallel _ _ _ through_recruits). cbn. tauto.
      + (* ALLOF-2 *)
        rewrite <- (app_nil_r E). apply Plain; auto. intros v. cbn [rest frame_recruits]. rewrite recruits_all_of. tauto.
      + (* DURING-2 *)
        apply Plain; auto. cbn. tauto.
      + (* REPEAT-2 *)
        inversion W; subst. destruct g.
        * rewrite <- (app_nil_r E). apply Plain; auto. cbn. tauto.
        * apply Plain; auto; [intros v; apply proj_begun | apply left_begun|]. intros v. cbn [rest frame_recruits].
          rewrite recruits_repeat, quiet_recruits by assumption. tauto.
      + (* RECRUIT-2 *)
        eapply leaving_fits; eauto.
    - (* it fails *)
      assert (Over := over_released _ _ _ _ _ _ _ _ _ HP' Hb' Hk Hf I).
      pose proof Hk as (K1 & K2 & K3 & K4).
      destruct f; cbn [plug lift on_err] in *;
        try (is_only Hin; rewrite <- (app_nil_r E); apply Plain; auto; cbn; tauto).
      + (* PAR-ERR *)
        is_only Hin. destruct (Wf_nodup _ _ W) as [N1 N2]. unfold run_of in N1. cbn [running recruits] in N1, N2.
        rewrite map_flat_map in N1. fold run_of in N1.
        change (flat_map (fun x0 => map fst (running x0)) (before ++ r :: after))
          with (flat_map run_of (before ++ r :: after)) in N1.
        assert (Drop : forall g : residual -> list vehicle,
          NoDup (flat_map g (before ++ r :: after)) -> NoDup (flat_map g (before ++ after))).
        { intros g. rewrite !flat_map_app. cbn [flat_map]. intros H.
          apply Permutation_NoDup with (l' := g r ++ flat_map g before ++ flat_map g after) in H.
          - induction (g r) as [|y ys IH]; [exact H|]. cbn in H. inversion H. auto.
          - rewrite !app_assoc. apply Permutation_app_tail, Permutation_app_comm. }
        assert (Hside : forall v, In v (flat_map names (before ++ after)) ->
          held K v = false /\ ~ In v (names r) /\ allocation S1 v = run_at (Parallel (before ++ r :: after)) v).
        { intros v Hv.
          assert (Hh : held (enter (Beside before after) K) v = true) by (cbn; apply mem_or; auto).
          assert (Hw : held K v = false).
          { destruct (held K v) eqn:Hw; [|reflexivity]. exfalso. apply (N v Hw). cbn [names].
            rewrite flat_map_app in *. cbn [flat_map]. rewrite !in_app_iff in *. tauto. }
          split; [exact Hw | split; [apply (not_held _ _ _ HP' v Hh)|]]. rewrite (K1 v Hh). apply R. exact Hw. }
        assert (Hrun : forall v, In v (flat_map run_of (before ++ after)) -> In v (flat_map names (before ++ after))).
        { intros v Hv. apply in_flat_map in Hv. destruct Hv as (q & Hq & Hv). apply in_flat_map. exists q.
          split; [exact Hq | apply running_named; exact Hv]. }
        assert (Hrec : forall v, In v (flat_map recruits (before ++ after)) -> In v (flat_map names (before ++ after))).
        { intros v Hv. apply in_flat_map in Hv. destruct Hv as (q & Hq & Hv). apply in_flat_map. exists q.
          split; [exact Hq | apply recruits_named; exact Hv]. }
        assert (Hall : forall v, run_at (Parallel (before ++ r :: after)) v = None <->
          ~ (In v (flat_map run_of (before ++ after)) \/ In v (run_of r))).
        { intros v. unfold run_at. rewrite lookup_none. cbn [running]. rewrite map_flat_map.
          change (fun x0 => map fst (running x0)) with run_of. rewrite !flat_map_app. cbn [flat_map].
          rewrite !in_app_iff. tauto. }
        split; [|split; [|exact I]].
        * intros v. rewrite proj_app, app_assoc, vrun_app, Before, F1. cbn [rest].
          rewrite cut_run; [|apply Drop; exact N1 | apply Drop; exact N2 | |].
          -- f_equal. f_equal. unfold here, around. cbn [frame_recruits does without with_allocation bound]. cbn [mem].
             destruct (mem v (flat_map recruits (before ++ after))) eqn:M.
             ++ apply mem_spec in M. symmetry. rewrite !orb_false_iff. repeat split.
                ** apply mem_false. intros H. apply (B5 v); [|apply K2; exact H].
                   apply (recruits_plug (Beside before after)). auto.
                ** destruct (X v) eqn:Xv; [|reflexivity]. exfalso. apply (B4 v Xv).
                   apply (recruits_plug (Beside before after)). auto.
             ++ rewrite !orb_false_r. reflexivity.
          -- intros Hv. destruct (Hside v (Hrun v Hv)) as (H1 & H2 & H3). split.
             ++ rewrite H3. intros H. apply Hall in H. tauto.
             ++ unfold here, around. rewrite !orb_true_iff, !mem_spec. cbn [frame_recruits].
                assert (Hv' : In v (run_of (Parallel (before ++ r :: after)))).
                { destruct (in_dec vehicle_eq v (run_of (Parallel (before ++ r :: after)))) as [J | J]; [exact J|].
                  exfalso. apply lookup_none in J. apply Hall in J. tauto. }
                destruct (Wf_running _ _ v W Hv') as [[H | H] | H].
                ** left. left. apply K3; [exact H|]. cbn. apply mem_or. right. apply Hrun. exact Hv.
                ** right. left. auto.
                ** right. right. apply (recruits_plug (Beside before after)) in H. destruct H as [H | H]; [exact H|].
                   exfalso. apply H2, recruits_named, H.
          -- intros Hv. destruct (Hside v (Hrec v Hv)) as (H1 & H2 & H3). split.
             ++ unfold here, around. cbn [frame_recruits]. rewrite (proj2 (mem_spec v _) Hv), !orb_true_r. reflexivity.
             ++ rewrite H3. destruct (in_dec vehicle_eq v (flat_map run_of (before ++ after))) as [J | J]; [auto|].
                right. apply Hall. intros [H | H]; [auto|]. apply H2, running_named, H.
        * intros v Xv. rewrite left_app, left_cut, in_app_iff. intros [H | H].
          -- apply (F2 v); auto.
          -- apply (B4 v Xv). apply (recruits_plug (Beside before after)). auto.
      + (* DURING-ERR *)
        is_only Hin. apply Plain; auto. cbn. tauto.
      + (* a handler *)
        assert (None_left : forall E' y v, In v (rest (Watch r h) (Ends y) (E ++ E')) -> False).
        { intros E' y v. cbn [rest recruits]. rewrite in_minus, left_app, in_app_iff. intros [H1 H2]. apply H2. left.
          apply Over. exact H1. }
        unfold on_error, handles_error in Hin.
        destruct (run_handler (handles h) m (world_of K) (held K) (needed K) S1)
          as [z s gone N0 ds | m' ds | m' ds | m' s gone N0 ds |] eqn:Hh; try contradiction.
        * destruct (rules_law _ _ _ _ _ _ _ _ _ _ _ Hh) as (D1 & D2 & _).
          assert (D3 := handler_law _ _ _ _ _ _ _ _ _ _ _ Hh).
          assert (Done : forall o, (forall v, In v (rest (Watch r h) o (E ++ effects_of ds)) -> False) ->
            fits x X K S (Watch r h) (By l (after_handler s gone N0 S1) o (E ++ effects_of ds))).
          { intros o Ho. eapply handler_fits; eauto. }
          destruct z as [ | | | t].
          -- is_only Hin. apply Done. intros v [].
          -- is_only Hin. apply Done. intros v [].
          -- destruct (anew h) as [(t & q)|]; is_only Hin; apply Done; intros v [].
          -- destruct (anew h) as [(u & q)|]; [destruct (deepest <=? depth q)|]; is_only Hin; apply Done; intros v [].
        * is_only Hin. apply Plain; auto; [intros v; apply proj_said | rewrite left_effects; apply releases_said|].
          cbn. tauto.
        * is_only Hin. split; [|split; [|split]].
          -- intros v. rewrite proj_app, proj_said, app_nil_r, Before, F1. f_equal. f_equal. symmetry.
             apply (here_around (In_watch h)). split; [intros H; destruct (None_left _ _ _ H) | intros [[] | []]].
          -- intros v Xv. rewrite left_app, left_effects, releases_said, app_nil_r. apply F2. auto.
          -- intros v Hv Ha. exfalso. apply Ha, K4. exact Hv.
          -- intros v Hv Hn. apply K3; [exact Hv|]. cbn. rewrite Hn. reflexivity.
        * destruct (halted_law _ _ _ _ _ _ _ _ _ _ _ Hh) as (D1 & D2 & D3 & _). is_only Hin.
          eapply handler_fits; eauto.
      + (* RECRUIT-ERR *)
        is_only Hin. eapply leaving_fits; eauto.
    - (* the program ends *)
      is_only Hin. destruct F3 as [F3 F4].
      assert (After : forall v, here X S1 (rest (plug f r) (Ends y) E) v = here (around f X) S1 (rest r (Ends y) E) v).
      { intros v. apply here_around. cbn [rest]. rewrite !in_minus, recruits_plug. split.
        - tauto.
        - intros [H | H]; [|tauto]. split; [auto|]. apply F2. unfold around. rewrite orb_true_iff, mem_spec. auto. }
      split; [|split; [|split]].
      + intros v. rewrite Before, F1, After. reflexivity.
      + intros v Xv. apply F2. auto.
      + intros v Hv Ha. destruct (held (enter f K) v) eqn:Hh; [|rewrite After; apply F3; assumption].
        (* beside the part *)
        destruct f; cbn [enter held] in Hh; try congruence. apply mem_or in Hh. destruct Hh as [Hh | Hh]; [congruence|].
        assert (Hl : allocation S v <> None).
        { cbn [loses] in Hlo. rewrite Hlo in Ha.
          destruct (in_dec token_eq (Plan_of v) (closes E ++ ends_token x)); [congruence | exact Ha]. }
        cbn [plug] in *. rewrite R in Hl by exact Hv.
        assert (Hv' : In v (run_of (Parallel (before ++ r :: after)))).
        { destruct (in_dec vehicle_eq v (run_of (Parallel (before ++ r :: after)))) as [J | J]; [exact J|].
          exfalso. apply Hl, lookup_none, J. }
        rewrite After. unfold here, around. rewrite !orb_true_iff, !mem_spec.
        destruct (Wf_running _ _ v W Hv') as [[H | H] | H].
        * left. left. apply F4; [exact H|]. cbn. apply mem_or. right. exact Hh.
        * right. left. auto.
        * apply (recruits_plug (Beside before after)) in H. destruct H as [H | H]; [auto|].
          exfalso. apply (not_held _ _ _ HP' v); [cbn; apply mem_or; auto | apply recruits_named; exact H].
      + intros v Hv Hn. apply F4; [exact Hv|]. destruct f; cbn; rewrite ?orb_true_iff; auto.
  Qed.

  Lemma goes_fits x K S r t : goes x K S r t -> forall X, sound K -> placed K S r -> beside X K S r -> fits x X K S r t.
  Proof.
    induction 1 as [K S r t H | K S f r t t' Hg IH Hl]; intros X HK HP Hb; [eapply own_fits; eassumption|].
    pose proof (placed_inside _ _ _ _ HP) as HP'. pose proof (sound_enter f _ HK) as HK'.
    eapply lift_fits; [exact HK | exact HP | exact Hb | | | | exact Hl].
    - eapply goes_kept; eassumption.
    - apply IH; auto. apply beside_inside; assumption.
    - eapply goes_loses. exact Hg.
  Qed.

  (** {1 N} *)

  (** The deeds that a label shows. Those of handlers, of the code of [during] and of code that halts it does not. *)
  Definition deeds_of (l : label) : list deed :=
    match l with LCheck ds | LAct ds | LCut ds => ds | LDid d => [d] | LInput k x => [Posted [(k, x)]] | _ => [] end.

  Definition bag_moves (S : shared) (t : transition) : Prop :=
    match t with
    | By l S' _ _ =>
        exists hidden, bag_run (of_deeds normal_pair (deeds_of l ++ hidden)) (pairs (space S)) (pairs (space S'))
    end.

  Lemma of_deeds_app a b : of_deeds normal_pair (a ++ b) = of_deeds normal_pair a ++ of_deeds normal_pair b.
  Proof. apply flat_map_app. Qed.

  Lemma bag_still S l S' o E : deeds_of l = [] -> space S' = space S -> bag_moves S (By l S' o E).
  Proof. intros Hl HS. exists []. rewrite Hl, HS. constructor. apply Permutation_refl. Qed.

  Lemma bag_shown S l S' o E ds :
    deeds_of l = ds -> bag_run (of_deeds normal_pair ds) (pairs (space S)) (pairs (space S')) -> bag_moves S (By l S' o E).
  Proof. intros Hl H. exists []. rewrite app_nil_r, Hl. exact H. Qed.

  Lemma bag_hidden S l S' o E ds :
    deeds_of l = [] -> bag_run (of_deeds normal_pair ds) (pairs (space S)) (pairs (space S')) -> bag_moves S (By l S' o E).
  Proof. intros Hl H. exists ds. rewrite Hl. exact H. Qed.

  Lemma coded_bag e c ys K S gives faulty t : In t (coded e c ys K S gives faulty) ->
    (forall x s N ds, bag_run (of_deeds normal_pair ds) (pairs (space S)) (pairs N) -> In t (gives x s N ds) ->
       bag_moves S t) ->
    (forall m ds, In t (faulty m ds) -> bag_moves S t) -> bag_moves S t.
  Proof.
    unfold coded, runs. intros H Hg Hf. destruct e; [contradiction|].
    destruct (run c ys (world_of K) (held K) S) as [x s N ds | m ds | m ds | m s N ds |] eqn:R; try contradiction.
    - eapply Hg; [apply (gives_law _ _ _ _ _ _ _ _ _ R) | exact H].
    - eapply Hf. exact H.
    - is_only H. apply bag_still; reflexivity.
    - is_only H. eapply bag_hidden; [reflexivity | apply (halts_law _ _ _ _ _ _ _ _ _ R)].
  Qed.

  Lemma guarded_bag e g K S holds fails faulty t : In t (guarded e g K S holds fails faulty) ->
    (forall s N ds, bag_run (of_deeds normal_pair ds) (pairs (space S)) (pairs N) -> In t (holds s N ds) ->
       bag_moves S t) ->
    (In t fails -> bag_moves S t) ->
    (forall m ds, In t (faulty m ds) -> bag_moves S t) -> bag_moves S t.
  Proof.
    unfold guarded. intros H Hh Hn Hf. eapply coded_bag; [exact H | |]; cbv beta.
    - intros x s N ds R Hin. destruct (truth x) as [[]|]; eauto; contradiction.
    - intros m ds Hin. destruct (is_unknown m); [contradiction | eauto].
  Qed.

  Lemma bag_more S l S1 o E S2 o' E' ds :
    bag_moves S (By l S1 o E) -> bag_run (of_deeds normal_pair ds) (pairs (space S1)) (pairs (space S2)) ->
    bag_moves S (By l S2 o' E').
  Proof.
    intros (hidden & H) H'. exists (hidden ++ ds). rewrite app_assoc, of_deeds_app. eapply bag_run_app; eassumption.
  Qed.

  Lemma bag_clear S l S1 o E ks o' E' : bag_moves S (By l S1 o E) -> bag_moves S (By l (clear ks S1) o' E').
  Proof. intros H. destruct (forget_events_law ks (space S1)) as (xs & Hx). eapply bag_more; [exact H | exact Hx]. Qed.

  (** What ends post. *)
  Definition posts (ds : list end_deed) : list deed :=
    flat_map (fun d => match d with Posts k x => [Posted [(k, x)]] | Assigns _ | Gives_back => [] end) ds.

  Lemma posts_run ds : forall N, bag_run (of_deeds normal_pair (posts ds)) (pairs N) (pairs (posted ds N)).
  Proof.
    induction ds as [|[k x | a |] ds IH]; intros N; try apply IH.
    - constructor. apply Permutation_refl.
    - change (posts (Posts k x :: ds)) with ([Posted [(k, x)]] ++ posts ds). rewrite of_deeds_app.
      eapply bag_run_app; [apply post_law | apply (IH (post [(k, x)] N))].
  Qed.

  Lemma bag_does S l S1 o E ds o' E' : bag_moves S (By l S1 o E) -> bag_moves S (By l (does ds S1) o' E').
  Proof. intros H. eapply bag_more; [exact H | apply posts_run]. Qed.

  Lemma own_bag e K S r t : In t (own e K S r) -> bag_moves S t.
  Proof.
    intros Ht. destruct r; cbn [own] in Ht; try contradiction.
    - destruct e; [contradiction|]. is_only Ht. apply bag_still; reflexivity.
    - destruct e as [[]|]; try contradiction; destruct (vehicle_eq v0 v) as [->|]; try contradiction; is_only Ht;
        apply bag_still; reflexivity.
    - eapply coded_bag; [exact Ht | |]; cbv beta.
      + intros x s N ds R H. is_only H. eapply bag_shown; [reflexivity | exact R].
      + intros m ds H. is_only H. apply bag_still; reflexivity.
    - eapply guarded_bag; [exact Ht | | |]; cbv beta.
      + intros s N ds R H. is_only H. eapply bag_shown; [reflexivity | exact R].
      + intros [].
      + intros m ds H. is_only H. apply bag_still; reflexivity.
    - apply in_each in Ht. destruct Ht as (b & y & after & _ & Ht). unfold choose in Ht.
      eapply guarded_bag; [exact Ht | | |]; cbv beta.
      + intros s N ds R H. is_only H. eapply (bag_clear S _ (with_code s N S) Ok []), bag_shown;
        [reflexivity | exact R].
      + intros [].
      + intros m ds H. is_only H. apply bag_still; reflexivity.
    - apply in_each in Ht. destruct Ht as (b & y & after & _ & Ht). unfold choose in Ht.
      eapply guarded_bag; [exact Ht | | |]; cbv beta.
      + intros s N ds R H. is_only H. eapply (bag_clear S _ (with_code s N S) Ok []), bag_shown;
        [reflexivity | exact R].
      + intros [].
      + intros m ds H. is_only H. apply bag_still; reflexivity.
    - eapply guarded_bag; [exact Ht | | |]; cbv beta.
      + intros s N ds R H. destruct k; [is_only H | contradiction].
        eapply (bag_does S _ (without (run_of r) (with_code s N S)) Ok []), bag_shown; [reflexivity | exact R].
      + intros H. destruct k; [contradiction | is_only H].
        apply (bag_does S _ (without (run_of r) S) Ok []), bag_still; reflexivity.
      + intros m ds H. is_only H. apply (bag_does S _ (without (run_of r) S) Ok []), bag_still; reflexivity.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction]. is_only Ht.
      apply bag_still; reflexivity.
    - destruct e as [[]|]; try contradiction; [destruct yes|]; (destruct (timer_eq i0 i); [|contradiction]);
        is_only Ht; apply bag_still; reflexivity.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction]. is_only Ht.
      apply (bag_does S _ (without (run_of r) S) Ok []), bag_still; reflexivity.
    - eapply coded_bag; [exact Ht | |]; cbv beta.
      + intros x s N ds R H. destruct (time_of d x); is_only H.
        * eapply (bag_clear S _ (with_code s N S) Ok []), bag_hidden; [reflexivity | exact R].
        * apply bag_still; reflexivity.
      + intros m ds H. is_only H. apply bag_still; reflexivity.
    - eapply guarded_bag; [exact Ht | | |]; cbv beta.
      + intros s N ds R H. is_only H. eapply bag_shown; [reflexivity | exact R].
      + intros H. is_only H. apply (bag_clear S _ S Ok []), bag_still; reflexivity.
      + intros m ds H. is_only H. apply bag_still; reflexivity.
    - eapply coded_bag; [exact Ht | |]; cbv beta.
      + intros x s N ds R H. destruct (made_task a ys q S x s ds); is_only H; apply bag_still; reflexivity.
      + intros m ds H. is_only H. apply bag_still; reflexivity.
    - destruct e; [contradiction|].
      destruct (alloc_made (world_of K) (held K) S (free K S) t0 q (taken_numbers K)) as [(vs & r) | m].
      + is_only Ht. apply (bag_clear S _ S Ok []), bag_still; reflexivity.
      + destruct (alloc_made (world_of K) (held K) S (its_bound K S) t0 q (taken_numbers K)); [contradiction|].
        is_only Ht. apply bag_still; reflexivity.
    - destruct e as [[]|]; try contradiction. destruct (timer_eq i0 i); [|contradiction].
      destruct (mem v (fit q (world_of K) (bound S)) && negb (named K v)); [|contradiction]. is_only Ht.
      apply bag_still; reflexivity.
  Qed.

  Lemma goes_bag x K S r t : goes x K S r t -> bag_moves S t.
  Proof.
    induction 1 as [K S r t H | K S f r t t' _ IH Hl]; [eapply own_bag; exact H|].
    destruct t as [l S1 [r' | | m | y] E].
    - is_only Hl. exact IH.
    - cbn [lift] in Hl. destruct Hl as [<- | []]. destruct f as [| | | | | | ? g ? | | | |];
        [..|destruct g|idtac|idtac|idtac|idtac];
        first [exact IH | eapply bag_clear; exact IH | eapply bag_does; exact IH].
    - destruct f; cbn [lift on_err] in Hl;
        try (is_only Hl; first [exact IH | eapply bag_clear; exact IH]; fail);
        try (is_only Hl; apply (bag_does S l _ Ok []); exact IH).
      unfold on_error, handles_error in Hl.
      destruct (run_handler (handles h) m (world_of K) (held K) (needed K) S1)
        as [z s gone N0 ds | m' ds | m' ds | m' s gone N0 ds |] eqn:Hh; try contradiction; try (is_only Hl; exact IH).
      + destruct (rules_law _ _ _ _ _ _ _ _ _ _ _ Hh) as (_ & _ & Hb).
        assert (G : forall o' E', bag_moves S (By l (after_handler s gone N0 S1) o' E')).
        { intros o' E'. eapply bag_more; [exact IH | exact Hb]. }
        destruct z as [ | | | t]; [ | | destruct (anew h) as [(t & q)|] |
          destruct (anew h) as [(u & q)|]; [destruct (deepest <=? depth q)|]]; is_only Hl; apply G.
      + destruct (halted_law _ _ _ _ _ _ _ _ _ _ _ Hh) as (_ & _ & _ & Hb). is_only Hl.
        eapply bag_more; [exact IH | exact Hb].
    - is_only Hl. exact IH.
  Qed.

  (** {1 Configurations} *)

  (** The refinement mapping. *)
  Definition mapped (c : configuration) : abstract :=
    {| tasks := allocation (shared_of c);
       holds := fun v => mem v (bound (shared_of c)) || mem v (recruited_by (control_of c));
       bag := pairs (space (shared_of c));
       over := match control_of c with End _ => true | _ => false end |}.

  Definition finish (c : configuration) : list abstract_event :=
    match control_of c with End _ => [AFinish] | _ => [] end.

  (** What the invariant gives. *)
  Record facts (c : configuration) : Prop := {
    f_bound : NoDup (bound (shared_of c));
    f_recruits : NoDup (recruited_by (control_of c));
    f_runs : NoDup (run_of (residual_of (control_of c)));
    f_apart : forall v, In v (recruited_by (control_of c)) -> ~ In v (bound (shared_of c));
    f_exactly : forall v, allocation (shared_of c) v <> None <-> In v (run_of (residual_of (control_of c)));
    f_within : forall v, In v (run_of (residual_of (control_of c))) ->
      mem v (bound (shared_of c)) || mem v (recruited_by (control_of c)) = true
  }.

  Lemma order_facts c : in_order c -> facts c.
  Proof.
    intros [HB HI]. destruct c as [k S]. cbn [control_of shared_of] in *.
    assert (Empty : residual_of k = Parallel [] -> (forall v, allocation S v = None) ->
      facts {| control_of := k; shared_of := S |}).
    { intros Hr Ha. split; cbn [control_of shared_of]; unfold recruited_by; rewrite ?Hr; cbn [recruits flat_map run_of
        running map].
      - exact HB.
      - constructor.
      - constructor.
      - intros v [].
      - intros v. rewrite Ha. split; [congruence | intros []].
      - intros v []. }
    destruct k as [M | M q | M r | y]; try (apply Empty; [reflexivity | apply HI]).
    destruct HI as (W & R & Hc). destruct (Wf_nodup _ _ W) as [N1 N2]. split; cbn; auto.
    - intros v. rewrite R. unfold run_at. split.
      + intros H. destruct (in_dec vehicle_eq v (run_of r)) as [J | J]; [exact J|]. exfalso. apply H, lookup_none, J.
      + intros H H'. apply lookup_none in H'. contradiction.
    - intros v Hv. rewrite orb_true_iff, !mem_spec. unfold recruited_by. cbn. apply (Wf_running _ _ v W Hv).
  Qed.

  Lemma facts_within c : facts c -> allocation_within_bound (mapped c).
  Proof. intros [H1 H2 H3 H4 H5 H6] v Hv. cbn in *. apply H6, H5, Hv. Qed.

  Lemma effects_vehicles E : forallb of_vehicles (flat_map of_effect E) = true.
  Proof.
    rewrite forallb_forall. intros e He. apply in_flat_map in He. destruct He as (x & _ & He).
    destruct x; cbn in He; try contradiction; try (destruct He as [<- | []]; reflexivity);
      apply in_map_iff in He; destruct He as (u & <- & _); reflexivity.
  Qed.

  Lemma event_vehicles x : forallb of_vehicles (of_event x) = true.
  Proof. destruct x as [[]|]; reflexivity. Qed.

  Lemma assemble c c' x E ds :
    in_order c -> in_order c' -> (forall y, control_of c <> End y) ->
    (forall v, vrun (proj_event v x ++ proj v E) (state_of (mapped c) v) = Some (state_of (mapped c') v)) ->
    bag_run (of_deeds normal_pair ds) (pairs (space (shared_of c))) (pairs (space (shared_of c'))) ->
    happen (of_event x ++ of_deeds normal_pair ds ++ flat_map of_effect E ++ finish c') (mapped c) (mapped c').
  Proof.
    intros Hi Hi' Hk Hv Hb.
    assert (Ho : over (mapped c) = false).
    { cbn. destruct (control_of c) eqn:Hc; try reflexivity. destruct (Hk e eq_refl). }
    assert (Hw := facts_within _ (order_facts _ Hi)). assert (Hw' := facts_within _ (order_facts _ Hi')).
    pose (f1 := fun v => match vrun (proj_event v x) (state_of (mapped c) v) with Some s => s | None => Out end).
    assert (H1 : forall v, vrun (proj_event v x) (state_of (mapped c) v) = Some (f1 v) /\
                           vrun (proj v E) (f1 v) = Some (state_of (mapped c') v)).
    { intros v. specialize (Hv v). rewrite vrun_app in Hv. unfold f1.
      destruct (vrun (proj_event v x) (state_of (mapped c) v)); [auto | discriminate]. }
    destruct (vehicles_happen (of_event x) (mapped c) f1 (event_vehicles x) Ho Hw (fun v => proj1 (H1 v)))
      as (s1 & R1 & B1 & O1 & W1 & S1).
    destruct (bag_happens _ _ _ s1 Hb) as (s2 & R2 & A2 & B2 & P2 & O2);
      [rewrite B1; apply Permutation_refl | exact O1 |].
    assert (S2 : forall v, state_of s2 v = f1 v).
    { intros v. rewrite <- (S1 v). unfold state_of. rewrite (A2 v), (B2 v). reflexivity. }
    assert (W2 : allocation_within_bound s2).
    { intros v. rewrite (A2 v), (B2 v). apply W1. }
    destruct (vehicles_happen (flat_map of_effect E) s2 (state_of (mapped c')) (effects_vehicles E) O2 W2)
      as (s3 & R3 & B3 & O3 & W3 & S3).
    { intros v. rewrite S2. apply H1. }
    destruct (state_same _ _ W3 Hw' S3) as [A4 B4].
    assert (P4 : Permutation (bag s3) (bag (mapped c'))) by (rewrite B3; exact P2).
    eapply happen_app; [exact R1|]. eapply happen_app; [exact R2|]. eapply happen_app; [exact R3|].
    unfold finish. destruct (control_of c') eqn:Hc';
      try (constructor; split; [exact A4 | split; [exact B4 | split; [exact P4|]]]; rewrite O3; cbn; rewrite Hc';
           reflexivity).
    econstructor; [|constructor; apply same_refl]. split; [exact O3|].
    assert (Hh : forall v, holds s3 v = false).
    { intros v. rewrite B4. destruct Hi' as [_ HI]. rewrite Hc' in HI. destruct HI as [_ HI]. cbn. rewrite HI, Hc'.
      reflexivity. }
    split; [exact Hh | split; [intros v; symmetry; apply A4 | split; [intros v; symmetry; apply B4 | split]]].
    - exact P4.
    - cbn. rewrite Hc'. reflexivity.
  Qed.

  Definition nowhere (v : vehicle) : bool := false.

  Lemma step_fits w e M S r l S' o E :
    in_order (executes M r S) -> step e (alone w) S r l S' o E ->
    fits e nowhere (alone w) S r (By l S' o E) /\ loses e S (By l S' o E) /\ bag_moves S (By l S' o E).
  Proof.
    intros [_ (W & R & Hc)] H. apply goes_iff_step in H.
    assert (HP := placed_alone w S r W R).
    split; [|split; [eapply goes_loses; exact H | eapply goes_bag; exact H]].
    apply (goes_fits _ _ _ _ _ H nowhere (sound_alone w) HP). split; try discriminate.
    - intros v [].
    - exact Hc.
  Qed.

  Lemma here_nowhere S cs v : here nowhere S cs v = mem v (bound S) || mem v cs.
  Proof. unfold here, nowhere. apply orb_false_r. Qed.

  Lemma proj_end v y : proj v [End_ y] = [].
  Proof. reflexivity. Qed.

  Lemma still_in S vs v : In v (still S vs) <-> In v vs /\ allocation S v <> None.
  Proof.
    unfold still. rewrite filter_In. destruct (allocation S v); split; intros [H1 H2]; split; auto; try congruence.
  Qed.

  (** The end stops all that runs and releases all that is held. *)
  Lemma ends_empty v S r rs x E y h :
    NoDup (run_of r) -> NoDup rs -> (allocation S v <> None -> In v (run_of r) /\ h = true) ->
    h = mem v rs ->
    vrun (proj v (stops x r E S ++ release rs ++ [End_ y])) (st (allocation S v) h) = Some Out.
  Proof.
    intros Hn Hr Ha Hh. unfold stops. rewrite <- !app_assoc, proj_app, proj_ceases. cbn [app].
    rewrite app_assoc, proj_app, proj_end, app_nil_r. rewrite stop_release; auto.
    - f_equal. destruct (mem v (still S (run_of r))) eqn:M.
      + rewrite <- Hh. destruct h; reflexivity.
      + apply mem_false in M. rewrite still_in in M. destruct (allocation S v) eqn:A.
        * exfalso. apply M. split; [apply Ha|]; congruence.
        * rewrite <- Hh. destruct h; reflexivity.
    - apply NoDup_filter. exact Hn.
    - intros Hv. apply still_in in Hv. destruct Hv as [_ Hv]. split; [exact Hv | apply Ha; exact Hv].
    - intros Hv. apply mem_spec in Hv. rewrite <- Hh in Hv. split; [exact Hv|].
      destruct (allocation S v) eqn:A; [left|right; reflexivity]. apply still_in. split; [apply Ha|]; congruence.
  Qed.

  Lemma ends_here_empty v S E y : (forall v, proj v E = []) -> NoDup (bound S) -> allocation S v = None ->
    vrun (proj v (end_here E S y)) (st (allocation S v) (mem v (bound S) || mem v [])) = Some Out.
  Proof.
    intros HE Hn Ha. unfold end_here. rewrite !proj_app, HE, proj_end, app_nil_r. cbn [app].
    rewrite (proj_release v _ Hn), Ha. cbn. destruct (mem v (bound S)); reflexivity.
  Qed.

  Lemma proj_script_waits v k : proj v (script_waits k) = [].
  Proof. destruct k as [M | M [] | M r | y]; reflexivity. Qed.

  Lemma left_script_waits k : left_alone (script_waits k) = [].
  Proof. destruct k as [M | M [] | M r | y]; reflexivity. Qed.

  Lemma vehicles_move w x c l c' E : in_order c -> cstep w x c l c' E ->
    forall v, vrun (proj_event v x ++ proj v E) (state_of (mapped c) v) = Some (state_of (mapped c') v).
  Proof.
    intros Hi Hs v. pose proof (order_facts _ Hi) as [F1 F2 F3 F4 F5 F6].
    assert (Hi' := invariant_is_inductive _ _ _ _ _ _ Hs Hi).
    unfold state_of, mapped. cbn [tasks holds].
    destruct Hs; cbn [control_of shared_of script_at waits_at executes ended proj_event of_event flat_map app
      recruited_by residual_of recruits] in *;
      try reflexivity;
      try (rewrite ends_here_empty; [reflexivity | reflexivity | exact F1 |]; apply Hi; fail).
    - (* RELEASE *)
      assert (Ha : allocation S v = None) by apply Hi.
      change [Release (v0 :: ws)] with (release (v0 :: ws)). rewrite <- H0.
      rewrite proj_release by (apply NoDup_filter; exact F1). cbn [with_bound with_store allocation bound]. rewrite Ha.
      cbn [mem]. rewrite !orb_false_r. destruct (mem v (both (bound S) vs)) eqn:Mm.
      + apply mem_spec, in_both in Mm. destruct Mm as [M1 M2]. rewrite (proj2 (mem_spec v _) M1).
        rewrite (proj2 (mem_false v (minus (bound S) vs))); [reflexivity|]. rewrite in_minus. tauto.
      + apply mem_false in Mm. rewrite in_both in Mm. cbn. rewrite (mem_same v (bound S) (minus (bound S) vs)); [reflexivity|].
        rewrite in_minus. tauto.
    - (* PICK-BIND *)
      assert (Ha : allocation S v = None) by apply Hi.
      change [Cancel_timer script_timer; Bind vs] with ([Cancel_timer script_timer] ++ [Bind vs]).
      rewrite proj_app. cbn [app]. change (proj v [Cancel_timer script_timer]) with (@nil vehicle_event). cbn [app].
      rewrite proj_bind by (eapply Sub_NoDup; [eassumption | apply fit_once_law]).
      cbn [with_bound allocation bound]. rewrite Ha, mem_app. cbn [mem]. rewrite !orb_false_r.
      destruct (mem v vs) eqn:Mm; [|rewrite orb_false_r; reflexivity]. apply mem_spec in Mm.
      apply (Sub_incl _ _ _ H), fit_law in Mm. rewrite (proj2 (mem_false v (bound S)) Mm). reflexivity.
    - (* PICK-BIND, of all *)
      assert (Ha : allocation S v = None) by apply Hi. rewrite <- H0.
      rewrite proj_bind by apply fit_once_law.
      cbn [with_bound allocation bound]. rewrite Ha, mem_app. cbn [mem]. rewrite !orb_false_r.
      destruct (mem v (fit (asked q) w (bound S))) eqn:Mm; [|rewrite orb_false_r; reflexivity].
      apply mem_spec, fit_law in Mm. rewrite (proj2 (mem_false v (bound S)) Mm). reflexivity.
    - (* EXECUTE *)
      assert (Ha : allocation S v = None) by apply Hi. apply alloc_built in H0. destruct H0 as (_ & Q & _).
      rewrite proj_begun. cbn [clear with_space with_code with_store allocation bound].
      rewrite Ha, (quiet_recruits r Q). reflexivity.
    - (* EXECUTE-DONE *)
      destruct (step_fits _ _ _ _ _ _ _ _ _ Hi H) as ((Hf & _) & _). specialize (Hf v).
      rewrite !here_nowhere in Hf. exact Hf.
    - (* EXECUTE-ERR *)
      destruct (step_fits _ _ _ _ _ _ _ _ _ Hi H) as ((Hf & _) & _). specialize (Hf v).
      rewrite !here_nowhere in Hf. cbn [rest] in Hf.
      pose proof Hi as [HB (W & R & Hc)].
      assert (Hn : forall u, allocation S' u = None).
      { intros u. eapply (nothing_runs_after _ _ _ _ _ _ _ _ (sound_alone w) (placed_alone w _ _ W R) H); eauto. }
      assert (Hd : NoDup (bound S')).
      { destruct (step_bound _ _ _ _ _ _ _ _ H) as [ws ->]. apply NoDup_minus. exact HB. }
      unfold end_by_error. rewrite still_none by exact Hn. cbn [map app].
      rewrite proj_app, app_assoc, vrun_app. fold (proj_event v e). rewrite Hf.
      rewrite proj_app, (proj_release v _ Hd), proj_end, app_nil_r, Hn. cbn. destruct (mem v (bound S')); reflexivity.
    - (* EXECUTING *)
      destruct (step_fits _ _ _ _ _ _ _ _ _ Hi H) as ((Hf & _) & _). specialize (Hf v).
      rewrite !here_nowhere in Hf. exact Hf.
    - (* HALT and the like, of a task *)
      destruct (step_fits _ _ _ _ _ _ _ _ _ Hi H) as ((Hf & _ & Hg & _) & Hl & _). specialize (Hf v).
      rewrite !here_nowhere in Hf. cbn [rest] in Hf. pose proof Hi as [HB (W & R & Hc)].
      destruct (step_bound _ _ _ _ _ _ _ _ H) as [ws Hws].
      assert (Hd : NoDup (bound S')) by (rewrite Hws; apply NoDup_minus; exact HB).
      unfold end_of. rewrite proj_app, app_assoc, vrun_app. fold (proj_event v e). rewrite Hf.
      rewrite ends_empty; [reflexivity | exact F3 | | |].
      + apply NoDup_app; [exact Hd | apply NoDup_minus; exact F2|]. intros u Hu Hb. apply in_minus in Hu.
        rewrite Hws in Hb. apply in_minus in Hb. destruct Hu as [Hu _], Hb as [Hb _]. apply (F4 u Hu Hb).
      + intros Ha. split.
        * apply F5. cbn [loses] in Hl. rewrite Hl in Ha.
          destruct (in_dec token_eq (Plan_of v) (closes E ++ ends_token e)); [congruence | exact Ha].
        * rewrite <- here_nowhere. apply (Hg v eq_refl Ha).
      + symmetry. apply mem_app.
    - (* INTERRUPT *)
      unfold end_of. rewrite proj_app, proj_script_waits. cbn [app].
      rewrite left_script_waits. unfold recruited_by in *. rewrite ends_empty; [reflexivity | exact F3 | | |].
      + apply NoDup_app; [exact F1 | apply NoDup_minus; exact F2|]. intros u Hu Hb. apply in_minus in Hu.
        destruct Hu as [Hu _]. apply (F4 u Hu Hb).
      + intros Ha. apply F5 in Ha. auto.
      + rewrite mem_app. f_equal. apply mem_same. rewrite in_minus. cbn. tauto.
    - (* ON-INTERRUPT *)
      rewrite proj_app, proj_script_waits. cbn [app]. unfold stops. rewrite proj_app, proj_ceases. cbn [app].
      rewrite proj_stops by (apply NoDup_filter; exact F3).
      cbn [gone_home task_over with_space with_code with_bound with_allocation nothing allocation bound].
      rewrite mem_app. cbn [mem]. rewrite orb_false_r.
      destruct (mem v (still S (run_of (residual_of k)))) eqn:Mm.
      + apply mem_spec, still_in in Mm. destruct Mm as [M1 M2]. rewrite (F6 v M1).
        destruct (allocation S v); [reflexivity | congruence].
      + apply mem_false in Mm. rewrite still_in in Mm. destruct (allocation S v) eqn:A; [|reflexivity].
        exfalso. apply Mm. split; [apply F5|]; congruence.
  Qed.

  Lemma bag_moves_all w x c l c' E : in_order c -> cstep w x c l c' E ->
    exists hidden,
      bag_run (of_deeds normal_pair (deeds_of l ++ hidden)) (pairs (space (shared_of c))) (pairs (space (shared_of c'))).
  Proof.
    intros Hi Hs.
    assert (Over : forall S S' l hidden,
      bag_run (of_deeds normal_pair (deeds_of l ++ hidden)) (pairs (space S)) (pairs (space S')) ->
      exists hidden,
        bag_run (of_deeds normal_pair (deeds_of l ++ hidden)) (pairs (space S)) (pairs (forget_all (space S')))).
    { intros S S' l0 hidden H. destruct (forget_all_events_law (space S')) as (xs & Hx).
      exists (hidden ++ [Consumed xs]). rewrite app_assoc, of_deeds_app. eapply bag_run_app; eassumption. }
    destruct Hs; cbn [deeds_of app];
      try (exact (Over S (does (ensured (residual_of k)) S) LInterrupt _ (posts_run _ _)));
      try (exists []; constructor; apply Permutation_refl);
      try (destruct (forget_all_events_law (space S)) as (xs & Hx); exists [Consumed xs]; exact Hx);
      try (destruct (forget_events_law (keys r) (space S)) as (xs & Hx); exists [Consumed xs]; exact Hx);
      try (destruct (step_fits _ _ _ _ _ _ _ _ _ Hi H) as (_ & _ & hidden & Hb);
           first [exact (ex_intro _ hidden Hb) | exact (Over S S' l hidden Hb)]).
    - exists []. apply post_law.
    - exists []. apply take_law. assumption.
    - exists []. apply post_law.
  Qed.

  (** Each transition is the event from outside, the deeds of code, and the requests, as events of the abstract system;
      the last is its end. *)
  Theorem refinement w x c l c' E : in_order c -> cstep w x c l c' E ->
    exists hidden,
      happen (of_event x ++ of_deeds normal_pair (deeds_of l ++ hidden) ++ flat_map of_effect E ++ finish c')
        (mapped c) (mapped c').
  Proof.
    intros Hi Hs. destruct (bag_moves_all _ _ _ _ _ _ Hi Hs) as [hidden Hb]. exists hidden. apply assemble; auto.
    - eapply invariant_is_inductive; eassumption.
    - intros y Hy. destruct Hs; try discriminate; eapply H0 || eapply H; eassumption.
    - eapply vehicles_move; eassumption.
  Qed.

  Lemma happen_behaviour es s s' : happen es s s' -> behaviour s -> behaviour s'.
  Proof.
    induction 1 as [s s' H | e es s s1 s' He Hs IH]; intros Hb.
    - eapply Goes_on; [exact Hb | left; exact H].
    - apply IH. eapply Goes_on; [exact Hb | right; eauto].
  Qed.

  (** So every configuration that a program comes to is one of the abstract system. *)
  Theorem behaviours_refine M s N c : pairs N = [] -> reachable M s N c -> behaviour (mapped c).
  Proof.
    intros HN H. induction H as [|w e c l c' E H IH Hs].
    - apply Starts. repeat split; auto.
    - destruct (refinement _ _ _ _ _ _ (always_in_order _ _ _ _ H) Hs) as [hidden Hh].
      eapply happen_behaviour; eassumption.
  Qed.
End Refinement.
