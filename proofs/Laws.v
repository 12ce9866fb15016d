(** The laws of docs/semantics.md, as strong bisimulations of residuals, for every task and from every shared part. By
    the theorems of [Congruence] they hold in every context. "Vehicles being given": the residuals have them. *)
From Coq Require Export Permutation.
From Dolphin Require Export Congruence.
Set Implicit Arguments.
Unset Strict Implicit.

Section Laws.
  Context {L : Names} {C : Code}.

  (** {1 Code of the laws} *)

  (** A guard that does nothing, and is [b]. *)
  Definition is_always (b : bool) (g : code) : Prop :=
    forall K S, exists x, runs g [] K S = Gives x (variables S) (space S) [] /\ truth x = Some b.

  (** Guards without faults and deeds, of which one holds where the other does not. *)
  Definition opposite (g g' : code) : Prop :=
    forall K S, exists x x' b, runs g [] K S = Gives x (variables S) (space S) [] /\ truth x = Some b /\
      runs g' [] K S = Gives x' (variables S) (space S) [] /\ truth x' = Some (negb b).

  (** A handler that does nothing but to give this verdict. *)
  Definition just (x : verdict) (h : handler) : Prop :=
    forall m K S, handles_error (handles h) m K S = Rules x (variables S) [] (space S) [].

  Lemma with_code_same S : with_code (variables S) (space S) S = S.
  Proof. destruct S. reflexivity. Qed.

  Lemma minus_nothing vs : minus vs [] = vs.
  Proof.
    unfold minus. induction vs as [|v vs IH]; [reflexivity|]. cbn [List.filter].
    destruct (mem v []) eqn:M; [apply mem_spec in M; contradiction|]. cbn [negb]. rewrite IH. reflexivity.
  Qed.

  Lemma after_nothing S : after_handler (variables S) [] (space S) S = S.
  Proof. unfold after_handler. rewrite with_code_same, minus_nothing. destruct S. reflexivity. Qed.

  (** {1 Contexts} *)

  Definition is_around (f : frame) (vs : list vehicle) (is : list timer) : Prop :=
    kind f = (0, []) /\ alike (frame_names f) vs /\ alike (frame_numbers f) is.

  Lemma similar_trans K1 K2 K3 : similar K1 K2 -> similar K2 K3 -> similar K1 K3.
  Proof. intros [] []. split; try congruence. eapply alike_trans; eassumption. Qed.

  Lemma enter_two f1 f2 f3 K vs1 is1 vs2 is2 : is_around f1 vs1 is1 -> is_around f2 vs2 is2 ->
    is_around f3 (vs1 ++ vs2) (is1 ++ is2) -> similar (enter f1 (enter f2 K)) (enter f3 K).
  Proof.
    intros (K1 & N1 & I1) (K2 & N2 & I2) (K3 & N3 & I3).
    assert (E : forall g : vehicle -> bool,
      (fun v => (g v || mem v (frame_names f2)) || mem v (frame_names f1)) = (fun v => g v || mem v (frame_names f3))).
    { intros g. apply functional_extensionality. intros v.
      rewrite (mem_alike v N1), (mem_alike v N2), (mem_alike v N3). destruct (g v); [reflexivity|]. cbn.
      destruct (mem v (vs1 ++ vs2)) eqn:M.
      - apply mem_spec, in_app_iff in M. apply orb_true_iff. rewrite !mem_spec. tauto.
      - apply mem_false in M. rewrite in_app_iff in M. apply orb_false_iff. rewrite !mem_false. tauto. }
    split.
    - reflexivity.
    - destruct f1, f2, f3; cbn [kind] in *; try discriminate; reflexivity.
    - destruct f1, f2, f3; cbn [kind] in *; try discriminate; apply E.
    - apply E.
    - cbn. intros i. rewrite !in_app_iff, (I1 i), (I2 i), (I3 i), in_app_iff. tauto.
    - destruct f1, f2, f3; cbn [kind] in *; try discriminate; cbn; rewrite !app_nil_r; reflexivity.
  Qed.

  Lemma enter_none f K : is_around f [] [] -> similar (enter f K) K.
  Proof.
    intros (K1 & N1 & I1).
    assert (E : forall g : vehicle -> bool, (fun v => g v || mem v (frame_names f)) = g).
    { intros g. apply functional_extensionality. intros v. rewrite (mem_alike v N1). cbn. apply orb_false_r. }
    split.
    - reflexivity.
    - destruct f; cbn [kind] in *; try discriminate; reflexivity.
    - destruct f; cbn [kind] in *; try discriminate; apply E.
    - apply E.
    - cbn. intros i. rewrite in_app_iff, (I1 i). cbn. tauto.
    - destruct f; cbn [kind] in *; try discriminate; cbn; apply app_nil_r.
  Qed.

  (** {1 Frames that do nothing} *)

  Lemma transparent f : simple f = true -> is_around f [] [] ->
    (forall r, normal r = true -> normal (plug f r) = true) ->
    (forall r, names (plug f r) = names r /\ numbers (plug f r) = numbers r /\ keys (plug f r) = keys r /\
       ensured (plug f r) = ensured r) ->
    (forall e K S r t, ~ In t (own e K S (plug f r))) ->
    (forall K v, exists t, lift f K v = [t] /\ agree (fun a b => a = plug f b) t v) ->
    forall r, normal r = true -> bisimilar (plug f r) r.
  Proof.
    intros Hf Ha Hn Hs Hown Hlift r Hr.
    apply (@by_relation _ _ (fun a b => normal b = true /\ a = plug f b)); [|auto].
    clear r Hr. intros a r (Hr & ->).
    assert (F : face (plug f r) r).
    { destruct (Hs r) as (N1 & N2 & N3 & N4).
      split; auto; [rewrite N1; apply alike_refl | destruct f; try discriminate Hf; apply alike_refl | rewrite N2;
        apply alike_refl | rewrite N3; apply alike_refl | rewrite N4; reflexivity]. }
    split; [exact F | split; intros e K S t Ht].
    - apply goes_plug in Ht; [|apply simple_not_beside, Hf]. destruct Ht as [Ht | (v & Hv & Ht)].
      { exfalso. eapply Hown. exact Ht. }
      destruct (Hlift K v) as (t' & E & Hag). rewrite E in Ht. destruct Ht as [-> | []].
      assert (Hv' := goes_similar Hv (enter_none K Ha)). exists v. split; [exact Hv'|].
      assert (Nv := goes_normal Hv' Hr). destruct t as [l S1 o E1], v as [l' S1' o' E1'].
      destruct Hag as (-> & -> & Ho). split; [reflexivity | split; [reflexivity|]]. destruct o, o'; auto. left. auto.
    - assert (Hv := goes_similar Ht (similar_sym (enter_none K Ha))).
      destruct (Hlift K t) as (t' & E & Hag). exists t'.
      split; [eapply Within; [exact Hv | rewrite E; left; reflexivity]|].
      assert (Nt := goes_normal Ht Hr). destruct t as [l S1 o E1], t' as [l' S1' o' E1'].
      destruct Hag as (-> & -> & Ho). split; [reflexivity | split; [reflexivity|]]. destruct o, o'; auto. left. auto.
  Qed.

  (** [until { false } run t = t] *)
  Theorem until_false g r : is_always false g -> normal r = true -> bisimilar (Until Completes g r) r.
  Proof.
    intros Hg. apply (@transparent (Body_until Completes g)); auto.
    - repeat split; apply alike_refl.
    - intros e K S x t. cbn [plug own]. unfold guarded, coded. destruct e; [auto|].
      destruct (Hg K S) as (y & -> & ->). auto.
    - intros K [l S1 o E]. destruct o; eexists; (split; [reflexivity | cbn; auto]).
  Qed.

  (** [assure { true } run t = t] *)
  Theorem assure_true at_site g r : is_always true g -> normal r = true -> bisimilar (Until (Fails at_site) g r) r.
  Proof.
    intros Hg. apply (@transparent (Body_until (Fails at_site) g)); auto.
    - repeat split; apply alike_refl.
    - intros e K S x t. cbn [plug own]. unfold guarded, coded. destruct e; [auto|].
      destruct (Hg K S) as (y & -> & ->). auto.
    - intros K [l S1 o E]. destruct o; eexists; (split; [reflexivity | cbn; auto]).
  Qed.

  (** [watch t onError { propagate() } = t] *)
  Theorem watch_propagate h r :
    just Propagates h -> solid_handler h = true -> normal r = true -> bisimilar (Watch r h) r.
  Proof.
    intros Hh Hs. apply (@transparent (In_watch h)); auto.
    - repeat split; apply alike_refl.
    - intros x Hx. cbn [plug normal]. rewrite Hx, Hs. reflexivity.
    - intros K [l S1 o E]. destruct o; try (eexists; (split; [reflexivity | cbn; auto]); fail).
      cbn [lift on_err]. unfold on_error. rewrite Hh. eexists. split; [reflexivity|]. cbn. rewrite after_nothing. auto.
  Qed.

  (** {1 Rounds} *)

  Lemma alike_repeat X (f : residual -> list X) more t :
    (forall r m g t, alike (f (Repeat r m g t)) (f r ++ f t)) -> alike (f (repeat_ t more None t)) (f t).
  Proof.
    intros H. assert (E : alike (f t ++ f t) (f t)) by (intros x; rewrite in_app_iff; tauto).
    destruct more as [[|n]|]; cbn [repeat_]; [apply alike_refl | |];
      (eapply alike_trans; [apply H | exact E]).
  Qed.

  (** [repeat n, t = t >> repeat n - 1, t], and [repeat t = t >> repeat t] *)
  Theorem repeat_unrolled r more t : some_left more = true -> normal r = true -> normal t = true ->
    bisimilar (Repeat r more None t) (sequence r (repeat_ t (option_map pred more) None t)).
  Proof.
    intros Hm Hr Ht. set (rest := repeat_ t (option_map pred more) None t).
    assert (Nrest : normal rest = true) by (apply normal_repeat; exact Ht).
    assert (A1 : alike (names rest) (names t)) by (apply (alike_repeat (f := names)); intros; apply alike_refl).
    assert (A3 : alike (numbers rest) (numbers t)) by (apply (alike_repeat (f := numbers)); intros; apply alike_refl).
    assert (A4 : keys rest = keys t) by apply keys_repeat.
    apply (@by_relation _ _ (fun a b => exists r, normal r = true /\ a = Repeat r more None t /\ b = sequence r rest));
      [|exists r; auto].
    clear r Hr. intros a b (r & Hr & -> & ->).
    assert (F : face (Repeat r more None t) (sequence r rest)).
    { split.
      - eapply alike_trans; [|apply alike_sym, alike_names_sequence].
        apply alike_app; [apply alike_refl | apply alike_sym, A1].
      - rewrite run_of_sequence. apply alike_refl.
      - eapply alike_trans; [|apply alike_sym, alike_numbers_sequence].
        apply alike_app; [apply alike_refl | apply alike_sym, A3].
      - cbn [normal]. rewrite Hr, Hm, Ht. reflexivity.
      - apply normal_sequence; assumption.
      - rewrite keys_sequence. apply alike_refl.
      - rewrite ensured_sequence. reflexivity. }
    assert (Ctx : forall K, similar (enter (Round_of more None t) K) (enter (In_sequence rest) K)).
    { intros K. apply enter_alike; [reflexivity | apply alike_sym, A1 | apply alike_sym, A3]. }
    split; [exact F | split; intros e K S u Hu].
    - change (Repeat r more None t) with (plug (Round_of more None t) r) in Hu.
      apply goes_plug in Hu; [|reflexivity]. destruct Hu as [[] | (v & Hv & Hu)].
      assert (Nv := goes_normal Hv Hr). eapply goes_similar in Hv; [|apply Ctx].
      destruct v as [l S1 [x | | m | x] E]; destruct Hu as [<- | []];
        (eexists; split; [apply goes_sequence; eexists; split; [exact Hv | left; reflexivity]|]);
        (split; [reflexivity | split; [rewrite ?A4; reflexivity|]]); auto.
      + left. exists x. auto.
      + right. apply bisimilar_refl. exact Nrest.
    - apply goes_sequence in Hu. destruct Hu as (v & Hv & Hu).
      assert (Nv := goes_normal Hv Hr).
      eapply goes_similar in Hv; [|apply similar_sym, Ctx].
      assert (Step : forall u', In u' (lift (Round_of more None t) K v) -> goes e K S (Repeat r more None t) u').
      { intros u' Hu'. change (Repeat r more None t) with (plug (Round_of more None t) r). eapply Within; eassumption. }
      destruct v as [l S1 [x | | m | x] E]; destruct Hu as [<- | []];
        (eexists; split; [apply Step; left; reflexivity|]);
        (split; [reflexivity | split; [rewrite ?A4; reflexivity|]]); auto.
      + left. exists x. auto.
      + right. apply bisimilar_refl. exact Nrest.
  Qed.

  (** {1 Cuts} *)

  (** [assure { g } run (t >> t') = (assure { g } run t) >> (assure { g } run t')] *)
  Theorem assure_sequence at_site g r t : normal r = true -> normal t = true ->
    bisimilar (Until (Fails at_site) g (sequence r t)) (sequence (Until (Fails at_site) g r) (Until (Fails at_site) g
      t)).
  Proof.
    intros Hr Ht.
    apply (@by_relation _ _ (fun a b => exists r, normal r = true /\ a = Until (Fails at_site) g (sequence r t) /\
      b = Sequence (Until (Fails at_site) g r) (Until (Fails at_site) g t))); [|exists r; auto].
    clear r Hr. intros a b (r & Hr & -> & ->).
    assert (Ns : normal (sequence r t) = true) by (apply normal_sequence; assumption).
    assert (F : face (Until (Fails at_site) g (sequence r t)) (Sequence (Until (Fails at_site) g r) (Until (Fails
      at_site) g t))).
    { split; [exact (alike_names_sequence r t) | | exact (alike_numbers_sequence r t) | exact Ns | | |].
      - change (alike (run_of (sequence r t)) (run_of r)). rewrite run_of_sequence. apply alike_refl.
      - cbn [normal is_sequence negb andb]. rewrite Hr, Ht. reflexivity.
      - change (alike (keys (sequence r t)) (keys r)). rewrite keys_sequence. apply alike_refl.
      - intros S. cbn [ensured]. rewrite ensured_sequence. reflexivity. }
    assert (A0 : forall x, is_around (Body_until (Fails at_site) x) [] []) by (intros x; repeat split;
      apply alike_refl).
    assert (A1 : forall x, is_around (In_sequence x) (names x) (numbers x)) by (intros x; repeat split;
      apply alike_refl).
    assert (Ctx : forall K, similar (enter (In_sequence t) (enter (Body_until (Fails at_site) g) K))
                                    (enter (Body_until (Fails at_site) g) (enter (In_sequence (Until (Fails at_site)
                                      g t)) K))).
    { intros K. apply (similar_trans (K2 := enter (In_sequence t) K)).
      - eapply enter_two; [apply A1 | apply A0 | rewrite !app_nil_r; apply A1].
      - apply similar_sym. eapply enter_two; [apply A0 | apply (A1 (Until (Fails at_site) g t)) | exact (A1 t)]. }
    split; [exact F | split; intros e K S u Hu].
    - change (Until (Fails at_site) g (sequence r t)) with (plug (Body_until (Fails at_site) g) (sequence r t)) in Hu.
      apply goes_plug in Hu; [|reflexivity]. destruct Hu as [Hu | (w & Hw & Hu)].
      + assert (Step : forall v u', In v (own e (enter (In_sequence (Until (Fails at_site) g t)) K) S (Until (Fails
        at_site) g r)) ->
          In u' (lift (In_sequence (Until (Fails at_site) g t)) K v) ->
            goes e K S (Sequence (Until (Fails at_site) g r) (Until (Fails at_site) g t)) u').
        { intros v u' Hv Hu'.
          change (Sequence (Until (Fails at_site) g r) (Until (Fails at_site) g t)) with (plug (In_sequence (Until
            (Fails at_site) g t)) (Until (Fails at_site) g r)).
          eapply Within; [apply Itself; exact Hv | exact Hu']. }
        cbn [plug own] in Hu, Step. unfold guarded, coded, breaks in Hu, Step. destruct e; [contradiction|].
        change (runs g [] (enter (In_sequence (Until (Fails at_site) g t)) K) S) with (runs g [] K S) in Step.
        rewrite run_of_sequence, ensured_sequence in Hu.
        destruct (runs g [] K S) as [x s N0 ds | m ds | m ds | m s N0 ds |]; try contradiction;
          [destruct (truth x) as [[]|] | destruct (is_unknown m) | |]; try contradiction; destruct Hu as [<- | []];
          (eexists; split; [eapply Step; [left; reflexivity | left; reflexivity]|]); cbn; auto.
      + apply goes_sequence in Hw. destruct Hw as (v & Hv & Hw). assert (Nv := goes_normal Hv Hr).
        eapply goes_similar in Hv; [|apply Ctx].
        assert (Step : forall v1 u', In v1 (lift (Body_until (Fails at_site) g) (enter (In_sequence (Until (Fails
          at_site) g t)) K) v) ->
          In u' (lift (In_sequence (Until (Fails at_site) g t)) K v1) ->
            goes e K S (Sequence (Until (Fails at_site) g r) (Until (Fails at_site) g t)) u').
        { intros v1 u' Hv1 Hu'.
          change (Sequence (Until (Fails at_site) g r) (Until (Fails at_site) g t)) with (plug (In_sequence (Until
            (Fails at_site) g t)) (plug (Body_until (Fails at_site) g) r)).
          eapply Within; [eapply Within; eassumption | exact Hu']. }
        destruct v as [l S1 [x | | m | x] E]; destruct Hw as [<- | []]; destruct Hu as [<- | []];
          (eexists; split; [eapply Step; [left; reflexivity | left; reflexivity]|]); (split; [reflexivity | split;
            [reflexivity|]]); auto.
        * left. exists x. auto.
        * right. apply bisimilar_refl. exact Ht.
    - change (Sequence (Until (Fails at_site) g r) (Until (Fails at_site) g t)) with (plug (In_sequence (Until (Fails
      at_site) g t)) (Until (Fails at_site) g r)) in Hu.
      apply goes_plug in Hu; [|reflexivity]. destruct Hu as [[] | (w & Hw & Hu)].
      change (Until (Fails at_site) g r) with (plug (Body_until (Fails at_site) g) r) in Hw.
      apply goes_plug in Hw; [|reflexivity]. destruct Hw as [Hw | (v & Hv & Hw)].
      + assert (Step : forall u', In u' (own e K S (Until (Fails at_site) g (sequence r t))) ->
        goes e K S (Until (Fails at_site) g (sequence r t)) u')
          by (intros; apply Itself; assumption).
        cbn [plug own] in Hw, Step. unfold guarded, coded, breaks in Hw, Step. destruct e; [contradiction|].
        change (runs g [] (enter (In_sequence (Until (Fails at_site) g t)) K) S) with (runs g [] K S) in Hw.
        rewrite run_of_sequence, ensured_sequence in Step.
        destruct (runs g [] K S) as [x s N0 ds | m ds | m ds | m s N0 ds |]; try contradiction;
          [destruct (truth x) as [[]|] | destruct (is_unknown m) | |]; try contradiction; destruct Hw as [<- | []];
          destruct Hu as [<- | []]; (eexists; split; [apply Step; left; reflexivity|]); cbn; auto.
      + assert (Nv := goes_normal Hv Hr).
        eapply goes_similar in Hv; [|apply similar_sym, Ctx].
        assert (Step : forall v1 u', In v1 (lift (In_sequence t) (enter (Body_until (Fails at_site) g) K) v) ->
          In u' (lift (Body_until (Fails at_site) g) K v1) -> goes e K S (Until (Fails at_site) g (sequence r t)) u').
        { intros v1 u' Hv1 Hu'. change (Until (Fails at_site) g (sequence r t)) with (plug (Body_until (Fails
          at_site) g) (sequence r t)).
          eapply Within; [apply goes_sequence; eexists; split; [exact Hv | exact Hv1] | exact Hu']. }
        destruct v as [l S1 [x | | m | x] E]; destruct Hw as [<- | []]; destruct Hu as [<- | []];
          (eexists; split; [eapply Step; [left; reflexivity | left; reflexivity]|]); (split; [reflexivity | split;
            [reflexivity|]]); auto.
        * left. exists x. auto.
        * right. apply bisimilar_refl. exact Ht.
  Qed.

  (** Frames that name nothing may change places. *)
  Lemma enter_swap f1 f2 K is1 is2 : is_around f1 [] is1 -> is_around f2 [] is2 ->
    similar (enter f1 (enter f2 K)) (enter f2 (enter f1 K)).
  Proof.
    intros (K1 & N1 & I1) (K2 & N2 & I2).
    assert (E : forall g : vehicle -> bool,
      (fun v => (g v || mem v (frame_names f2)) || mem v (frame_names f1)) =
      (fun v => (g v || mem v (frame_names f1)) || mem v (frame_names f2))).
    { intros g. apply functional_extensionality. intros v. rewrite <- !orb_assoc. f_equal. apply orb_comm. }
    split; [reflexivity | | | | |].
    - destruct f1, f2; cbn [kind] in *; try discriminate; reflexivity.
    - destruct f1, f2; cbn [kind] in *; try discriminate; apply E.
    - apply E.
    - cbn. intros i. rewrite !in_app_iff. tauto.
    - destruct f1, f2; cbn [kind] in *; try discriminate; reflexivity.
  Qed.

  (** A cut that is an error, which the handler ignores, is a cut that is none. *)
  Lemma ignored_cut f f' h is : just Ignores h -> solid_handler h = true ->
    simple f = true -> simple f' = true -> is_around f [] is -> is_around f' [] is ->
    (forall r, normal (plug f r) = normal r /\ normal (plug f' r) = normal r /\
       names (plug f r) = names r /\ names (plug f' r) = names r /\ run_of (plug f r) = run_of r /\
       run_of (plug f' r) = run_of r /\ numbers (plug f r) = is ++ numbers r /\
         numbers (plug f' r) = is ++ numbers r /\ keys (plug f r) = keys r /\ keys (plug f' r) = keys r /\
         ensured (plug f r) = ensured r /\ ensured (plug f' r) = ensured r) ->
    (forall r, replug f r = plug f r /\ replug f' r = plug f' r) ->
    (forall K l S1 E, (exists E1, lift f K (By l S1 Ok E) = [By l S1 Ok E1]) /\
       (exists E1, lift f' K (By l S1 Ok E) = [By l S1 Ok E1]) /\
       (forall m, exists E1, lift f K (By l S1 (Err m) E) = [By l S1 (Err m) E1])) ->
    (forall e K S r t, In t (own e K S (plug f r)) -> exists l S1 m E E1, t = By l S1 (Err m) E /\
       In (By l S1 Ok E1) (own e K S (plug f' (Watch r h)))) ->
    (forall e K S r t, In t (own e K S (plug f' (Watch r h))) -> exists l S1 m E E1, t = By l S1 Ok E /\
       In (By l S1 (Err m) E1) (own e K S (plug f r))) ->
    forall r, normal r = true -> bisimilar (Watch (plug f r) h) (plug f' (Watch r h)).
  Proof.
    intros Hh Hs Hf Hf' Ha Ha' Hface Hre Hlift Hown Hown' r Hr.
    apply (@by_relation _ _ (fun a b => exists r, normal r = true /\ a = Watch (plug f r) h /\
      b = plug f' (Watch r h)));
      [|exists r; auto].
    clear r Hr. intros a b (r & Hr & -> & ->).
    destruct (Hface r) as (N1 & _ & N3 & _ & N5 & _ & N7 & _ & N9 & _ & N11 & _).
    destruct (Hface (Watch r h)) as (_ & N2 & _ & N4 & _ & N6 & _ & N8 & _ & N10 & _ & N12).
    assert (F : face (Watch (plug f r) h) (plug f' (Watch r h))).
    { split.
      - cbn [names]. rewrite N3, N4. apply alike_refl.
      - change (alike (run_of (plug f r)) (run_of (plug f' (Watch r h)))). rewrite N5, N6. apply alike_refl.
      - cbn [numbers]. rewrite N7, N8. apply alike_refl.
      - cbn [normal]. rewrite N1, Hr, Hs. reflexivity.
      - rewrite N2. cbn [normal]. rewrite Hr, Hs. reflexivity.
      - change (alike (keys (plug f r)) (keys (plug f' (Watch r h)))). rewrite N9, N10. apply alike_refl.
      - intros S. change (ensured (Watch (plug f r) h)) with (ensured (plug f r)). rewrite N11, N12. reflexivity. }
    assert (Hw : forall K l S1 m E, on_error h K l S1 m E = [By l S1 Ok (E ++ [])]).
    { intros. unfold on_error. rewrite Hh. cbn. rewrite after_nothing. reflexivity. }
    assert (Aw : is_around (In_watch h) [] []) by (repeat split; apply alike_refl).
    split; [exact F | split; intros e K S u Hu].
    - change (Watch (plug f r) h) with (plug (In_watch h) (plug f r)) in Hu.
      apply goes_plug in Hu; [|reflexivity]. destruct Hu as [[] | (w & Hw1 & Hu)].
      apply goes_plug in Hw1; [|apply simple_not_beside, Hf]. destruct Hw1 as [Hw1 | (v & Hv & Hw1)].
      + destruct (Hown _ _ _ _ _ Hw1) as (l & S1 & m & E & E1 & -> & Hin). cbn [lift on_err] in Hu. rewrite Hw in Hu.
        destruct Hu as [<- | []]. eexists. split; [apply Itself|].
        * erewrite own_similar; [exact Hin | apply similar_sym, enter_none, Aw].
        * cbn. auto.
      + assert (Nv := goes_normal Hv Hr). eapply goes_similar in Hv; [|eapply enter_swap; [exact Ha | exact Aw]].
        assert (Step : forall v1 u', In v1 (lift (In_watch h) (enter f' K) v) -> In u' (lift f' K v1) ->
                  goes e K S (plug f' (Watch r h)) u').
        { intros v1 u' Hv1 Hu'. eapply Within; [|exact Hu']. change (Watch r h) with (plug (In_watch h) r).
          eapply Within; [eapply goes_similar; [exact Hv|] | exact Hv1]. apply enter_similar, enter_alike.
          - destruct Ha as [-> _], Ha' as [-> _]. reflexivity.
          - destruct Ha as (_ & A1 & _), Ha' as (_ & A2 & _). eapply alike_trans; [exact A1 | apply alike_sym, A2].
          - destruct Ha as (_ & _ & A1), Ha' as (_ & _ & A2). eapply alike_trans; [exact A1 | apply alike_sym, A2]. }
        destruct v as [l S1 [x | | m | x] E].
        * destruct Hw1 as [<- | []]. destruct (Hre x) as [R1 _]. rewrite R1 in Hu. destruct Hu as [<- | []].
          eexists. split; [eapply Step; [left; reflexivity | left;
            reflexivity]|]. destruct (Hre (Watch x h)) as [_ R2]. cbn [replug].
          split; [reflexivity | split; [reflexivity|]]. left. exists x. split; [exact Nv | split;
            [reflexivity | exact R2]].
        * destruct (Hlift (enter (In_watch h) K) l S1 E) as ((E1 & L1) & _). rewrite L1 in Hw1.
          destruct Hw1 as [<- | []].
          destruct Hu as [<- | []]. destruct (Hlift K l S1 E) as (_ & (E2 & L2) & _).
          eexists. split; [eapply Step; [left; reflexivity | cbn [on_ok]; rewrite L2; left; reflexivity]|]. cbn. auto.
        * destruct (Hlift (enter (In_watch h) K) l S1 E) as (_ & _ & L1). destruct (L1 m) as (E1 & L1').
          rewrite L1' in Hw1. destruct Hw1 as [<- | []]. cbn [lift on_err] in Hu. rewrite Hw in Hu.
          destruct Hu as [<- | []]. destruct (Hlift K l S1 (E ++ [])) as (_ & (E2 & L2) & _).
          eexists. split; [eapply Step; [cbn [lift on_err]; rewrite Hw; left; reflexivity | rewrite L2; left;
            reflexivity]|].
          cbn. auto.
        * destruct Hw1 as [<- | []]. destruct Hu as [<- | []].
          eexists. split; [eapply Step; [left; reflexivity | left; reflexivity]|]. cbn. auto.
    - apply goes_plug in Hu; [|apply simple_not_beside, Hf']. destruct Hu as [Hu | (w & Hw1 & Hu)].
      + destruct (Hown' _ _ _ _ _ Hu) as (l & S1 & m & E & E1 & -> & Hin).
        exists (By l S1 Ok (E1 ++ [])). split; [|cbn; auto].
        change (Watch (plug f r) h) with (plug (In_watch h) (plug f r)).
        eapply Within; [apply Itself; erewrite own_similar; [exact Hin | apply enter_none, Aw]|].
        cbn [lift on_err]. rewrite Hw. left. reflexivity.
      + change (Watch r h) with (plug (In_watch h) r) in Hw1. apply goes_plug in Hw1; [|reflexivity].
        destruct Hw1 as [[] | (v & Hv & Hw1)].
        assert (Nv := goes_normal Hv Hr).
        assert (Hv2 : goes e (enter f (enter (In_watch h) K)) S r v).
        { eapply goes_similar; [exact Hv|]. apply (similar_trans (K2 := enter (In_watch h) (enter f K))).
          - apply enter_similar, enter_alike.
            + destruct Ha as [-> _], Ha' as [-> _]. reflexivity.
            + destruct Ha as (_ & A1 & _), Ha' as (_ & A2 & _). eapply alike_trans; [exact A2 | apply alike_sym, A1].
            + destruct Ha as (_ & _ & A1), Ha' as (_ & _ & A2). eapply alike_trans; [exact A2 | apply alike_sym, A1].
          - eapply enter_swap; [exact Aw | exact Ha]. }
        assert (Step : forall v1 u', In v1 (lift f (enter (In_watch h) K) v) -> In u' (lift (In_watch h) K v1) ->
                  goes e K S (Watch (plug f r) h) u').
        { intros v1 u' Hv1 Hu'. change (Watch (plug f r) h) with (plug (In_watch h) (plug f r)).
          eapply Within; [eapply Within; [exact Hv2 | exact Hv1] | exact Hu']. }
        destruct v as [l S1 [x | | m | x] E].
        * destruct Hw1 as [<- | []]. destruct (Hre (Watch x h)) as [_ R2]. cbn [lift] in Hu. cbn [replug plug] in Hu.
          rewrite R2 in Hu. destruct Hu as [<- | []]. destruct (Hre x) as [R1 _].
          eexists. split; [eapply Step; [left; reflexivity | left; reflexivity]|].
          split; [reflexivity | split; [reflexivity|]]. left. exists x.
          split; [exact Nv | split; [cbn [replug plug]; rewrite R1; reflexivity | reflexivity]].
        * destruct Hw1 as [<- | []]. cbn [on_ok] in Hu. destruct (Hlift K l S1 E) as (_ & (E2 & L2) & _).
          rewrite L2 in Hu. destruct Hu as [<- | []].
          destruct (Hlift (enter (In_watch h) K) l S1 E) as ((E1 & L1) & _).
          eexists. split; [eapply Step; [rewrite L1; left; reflexivity | left; reflexivity]|]. cbn. auto.
        * cbn [lift on_err] in Hw1. rewrite Hw in Hw1. destruct Hw1 as [<- | []].
          destruct (Hlift K l S1 (E ++ [])) as (_ & (E2 & L2) & _). rewrite L2 in Hu. destruct Hu as [<- | []].
          destruct (Hlift (enter (In_watch h) K) l S1 E) as (_ & _ & L1). destruct (L1 m) as (E1 & L1').
          eexists. split; [eapply Step; [rewrite L1'; left; reflexivity | cbn [lift on_err]; rewrite Hw; left;
            reflexivity]|].
          cbn. auto.
        * destruct Hw1 as [<- | []]. destruct Hu as [<- | []].
          eexists. split; [eapply Step; [left; reflexivity | left; reflexivity]|]. cbn. auto.
  Qed.

  (** [watch (assure { g } run t) onError { ignore() } = until { !g } run watch t onError { ignore() }] *)
  Theorem watch_assure at_site g g' h r : opposite g g' -> just Ignores h -> solid_handler h = true ->
    normal r = true ->
    bisimilar (Watch (Until (Fails at_site) g r) h) (Until Completes g' (Watch r h)).
  Proof.
    intros Hg Hh Hs. apply (@ignored_cut (Body_until (Fails at_site) g) (Body_until Completes g') h []);
      auto; try (repeat split; apply alike_refl); try (intros; repeat split; reflexivity).
    - intros K l S1 E. split; [eexists; reflexivity | split; [eexists; reflexivity | intros m; eexists; reflexivity]].
    - intros e K S x t. cbn [plug own]. unfold guarded, coded. destruct e; [intros []|].
      destruct (Hg K S) as (y & y' & b & -> & -> & -> & ->). destruct b; [intros []|]. intros [<- | []].
      rewrite with_code_same. do 5 eexists. split; [reflexivity | left; reflexivity].
    - intros e K S x t. cbn [plug own]. unfold guarded, coded. destruct e; [intros []|].
      destruct (Hg K S) as (y & y' & b & -> & -> & -> & ->). destruct b; [intros []|]. intros [<- | []].
      rewrite with_code_same. do 5 eexists. split; [reflexivity | left; reflexivity].
  Qed.

  (** [watch (t within n) onError { ignore() } = during n run watch t onError { ignore() }] *)
  Theorem watch_within at_site i n h r : just Ignores h -> solid_handler h = true -> normal r = true ->
    bisimilar (Watch (During (Fails at_site) i n r) h) (During Completes i n (Watch r h)).
  Proof.
    intros Hh Hs. apply (@ignored_cut (Body_during (Fails at_site) i n) (Body_during Completes i n) h [i]);
      auto; try (repeat split; apply alike_refl); try (intros; repeat split; reflexivity).
    - intros K l S1 E. split; [eexists; reflexivity | split; [eexists; reflexivity | intros m; eexists; reflexivity]].
    - intros e K S x t. cbn [plug own]. destruct e as [[]|]; try (intros []; fail).
      destruct (timer_eq i0 i); [|intros []]. intros [<- | []]. do 5 eexists. split; [reflexivity | left; reflexivity].
    - intros e K S x t. cbn [plug own]. destruct e as [[]|]; try (intros []; fail).
      destruct (timer_eq i0 i); [|intros []]. intros [<- | []]. do 5 eexists. split; [reflexivity | left; reflexivity].
  Qed.

  (** {1 Side by side, and branches} *)

  Lemma alike_permuted X Y (f : X -> list Y) xs ys : Permutation xs ys -> alike (flat_map f xs) (flat_map f ys).
  Proof. intros H y. split; apply Permutation_in; [|symmetry]; apply Permutation_flat_map; assumption. Qed.

  Lemma forallb_permuted X (f : X -> bool) xs ys : Permutation xs ys -> forallb f xs = forallb f ys.
  Proof. induction 1; cbn; try congruence. destruct (f x), (f y); reflexivity. Qed.

  Lemma permuted_split X (b : list X) r a ys : Permutation (b ++ r :: a) ys ->
    exists b' a', ys = b' ++ r :: a' /\ Permutation (b ++ a) (b' ++ a').
  Proof.
    intros H. assert (Hin : In r ys) by (eapply Permutation_in; [exact H | apply in_elt]).
    apply in_split in Hin. destruct Hin as (b' & a' & ->). exists b', a'. split; [reflexivity|].
    eapply Permutation_app_inv. exact H.
  Qed.

  (** [t | t' = t' | t], and so for any order of any number of them. *)
  Theorem parallel_permuted rs rs' : ends_commute -> Permutation rs rs' -> normal (Parallel rs) = true ->
    bisimilar (Parallel rs) (Parallel rs').
  Proof.
    intros commute H Hn.
    apply (@by_symmetric_relation _ _ (fun a b => normal a = true /\ exists rs rs', Permutation rs rs' /\
      a = Parallel rs /\ b = Parallel rs')); [| |split; [exact Hn | exists rs, rs'; auto]].
    - intros a b (Na & xs & ys & Hp & -> & ->). split.
      + cbn [normal] in *. rewrite <- (Permutation_length Hp), <- (forallb_permuted _ Hp). exact Na.
      + exists ys, xs. split; [symmetry; exact Hp | auto].
    - clear - commute. intros a b (Na & xs & ys & Hp & -> & ->).
      assert (Nb : normal (Parallel ys) = true).
      { cbn [normal] in *. rewrite <- (Permutation_length Hp), <- (forallb_permuted _ Hp). exact Na. }
      split.
      { split; auto; [apply (alike_permuted names Hp) | | apply (alike_permuted numbers Hp) | apply (alike_permuted
        keys Hp) | exact (does_permuted commute (Permutation_flat_map ensured Hp) (ensured_allowed Na))].
        rewrite !through_run_of. apply alike_permuted. exact Hp. }
      intros e K S u Hu. assert (Nu := goes_normal Hu Na).
      apply goes_parts in Hu. destruct Hu as [[] | (f & r & v & Hin & Hv & Hu)].
      apply in_parts in Hin. destruct f; try discriminate Hin. injection Hin as ->.
      destruct (permuted_split Hp) as (b' & a' & -> & Hp').
      rewrite lift_beside in Hu. destruct Hu as [<- | []].
      assert (G : goes e K S (Parallel (b' ++ r :: a')) (surround b' a' v)).
      { change (Parallel (b' ++ r :: a')) with (plug (Beside b' a') r).
        eapply Within; [|rewrite lift_beside; left; reflexivity].
        eapply goes_similar; [exact Hv|]. apply enter_alike; [reflexivity | |]; apply alike_permuted; exact Hp'. }
      exists (surround b' a' v). split; [exact G|]. assert (Nu' := goes_normal G Nb).
      destruct v as [l S1 [x | | m | x] E]; cbn [surround next_normal] in *.
      + split; [reflexivity | split; [reflexivity|]]. left. split; [exact Nu|].
        exists (before ++ flat x ++ after), (b' ++ flat x ++ a'). split; [|auto].
        rewrite (Permutation_app_swap_app before (flat x) after), (Permutation_app_swap_app b' (flat x) a').
        apply Permutation_app_head. exact Hp'.
      + split; [reflexivity | split; [reflexivity|]].
        assert (Hb : branches_of (before ++ after) = true).
        { cbn [normal] in Na. rewrite andb_true_iff in Na. destruct Na as [Na1 Na2]. apply Nat.leb_le in Na1.
          apply (split_branches Na2 Na1). }
        assert (Hl := Permutation_length Hp').
        destruct (before ++ after) as [|y [|y' rest]] eqn:E1.
        * apply Permutation_nil in Hp'. rewrite Hp'. right. apply bisimilar_refl. rewrite Hp' in Nu'. exact Nu'.
        * apply Permutation_length_1_inv in Hp'. rewrite Hp'. right. apply bisimilar_refl. exact Nu.
        * assert (Hb' : branches_of (b' ++ a') = true).
          { unfold branches_of. rewrite <- (forallb_permuted _ Hp'). exact Hb. }
          assert (L1 : 2 <= length (y :: y' :: rest)) by (cbn; lia).
          assert (L2 : 2 <= length (b' ++ a')) by (rewrite <- Hl; exact L1).
          rewrite (parallel_branches Hb L1) in *. rewrite (parallel_branches Hb' L2) in *.
          left. split; [exact Nu|]. exists (y :: y' :: rest), (b' ++ a'). auto.
      + split; [reflexivity | split; [|reflexivity]].
        rewrite (without_alike (vs := flat_map run_of (before ++ after)) (ws := flat_map run_of (b' ++ a')))
          by (apply alike_permuted; exact Hp').
        apply (does_permuted commute); [apply Permutation_flat_map; exact Hp'|]. apply ensured_branches.
        cbn [normal] in Na. rewrite andb_true_iff in Na. destruct Na as [Na1 Na2]. apply Nat.leb_le in Na1.
        apply (split_branches Na2 Na1).
      + cbn. auto.
  Qed.

  Lemma parallel_two a b : normal a = true -> normal b = true -> parallel [a; b] = Parallel (flat a ++ flat b).
  Proof.
    intros Ha Hb. destruct (normal_flat a Ha) as [_ A2], (normal_flat b Hb) as [_ B2].
    unfold parallel. cbn [flat_map]. rewrite app_nil_r.
    destruct (flat a) as [|x xs]; [congruence|]. destruct (flat b) as [|y ys]; [congruence|]. destruct xs; reflexivity.
  Qed.

  Corollary parallel_comm a b : ends_commute -> normal a = true -> normal b = true ->
    bisimilar (parallel [a; b]) (parallel [b; a]).
  Proof.
    intros commute Ha Hb. assert (Hn : normal (parallel [a; b]) = true).
    { apply normal_parallel; [discriminate|]. cbn. rewrite Ha, Hb. reflexivity. }
    rewrite !parallel_two in * by assumption.
    apply parallel_permuted; [exact commute | apply Permutation_app_comm | exact Hn].
  Qed.

  Theorem parallel_assoc a b c : normal a = true -> normal b = true -> normal c = true ->
    parallel [parallel [a; b]; c] = parallel [a; parallel [b; c]].
  Proof.
    intros Ha Hb Hc.
    assert (N : forall x y, normal x = true -> normal y = true -> normal (parallel [x; y]) = true).
    { intros x y Hx Hy. apply normal_parallel; [discriminate|]. cbn. rewrite Hx, Hy. reflexivity. }
    rewrite (parallel_two (N a b Ha Hb) Hc), (parallel_two Ha (N b c Hb Hc)), (parallel_two Ha Hb),
      (parallel_two Hb Hc).
    cbn [flat]. rewrite app_assoc. reflexivity.
  Qed.

  (** Branches of [oneOf] and [allOf] commute. *)
  Theorem branches_permuted bs bs' : Permutation bs bs' ->
    (normal (One_of bs) = true -> bisimilar (One_of bs) (One_of bs')) /\
    (normal (All_of bs) = true -> bisimilar (All_of bs) (All_of bs')) /\
    (forall r, normal (Branch r bs) = true -> bisimilar (Branch r bs) (Branch r bs')).
  Proof.
    set (Q := fun a b => normal a = true /\ exists bs bs', Permutation bs bs' /\
      ((a = One_of bs /\ b = One_of bs') \/ (a = All_of bs /\ b = All_of bs') \/
       exists r, a = Branch r bs /\ b = Branch r bs')).
    assert (N : forall a b, Q a b -> normal b = true).
    { intros a b (Na & xs & ys & Hp & [(-> & ->) | [(-> & ->) | (r & -> & ->)]]); cbn [normal] in *;
        rewrite <- (Permutation_length Hp), <- (forallb_permuted _ Hp); exact Na. }
    assert (G : forall a b, Q a b -> bisimilar a b).
    { apply by_symmetric_relation.
      - intros a b Hab. split; [eapply N; exact Hab|]. destruct Hab as (Na & xs & ys & Hp & H).
        exists ys, xs. split; [symmetry; exact Hp|].
        destruct H as [(-> & ->) | [(-> & ->) | (r & -> & ->)]]; eauto.
      - intros a b Hab. assert (Nb := N a b Hab). destruct Hab as (Na & xs & ys & Hp & H).
        assert (A1 := alike_permuted (fun b => names (snd b)) Hp).
          assert (A3 := alike_permuted (fun b => numbers (snd b)) Hp).
        split.
        { destruct H as [(-> & ->) | [(-> & ->) | (r & -> & ->)]]; split; try assumption; try apply alike_refl;
            try reflexivity; (apply alike_app; [apply alike_refl | assumption]). }
        assert (Choosing : forall e K S (surrounds : list branch -> residual -> residual) t,
          (forall y b a b' a', Permutation (b ++ a) (b' ++ a') -> forall x, xs = b ++ (y, x) :: a ->
             forall ds, up Q (surrounds (b ++ a) (given ds x)) (surrounds (b' ++ a') (given ds x))) ->
          In t (each (choose e K S surrounds) [] xs) ->
          exists t', In t' (each (choose e K S surrounds) [] ys) /\ agree (up Q) t t').
        { intros e K S surrounds t Hs Ht. apply in_each in Ht. destruct Ht as (b0 & y & a0 & -> & Ht). cbn [app] in Ht.
          destruct (permuted_split Hp) as (b' & a' & -> & Hp'). destruct y as [g x].
          destruct (@choose_agree _ _ (up Q) e K S surrounds surrounds b0 (g, x) a0 b' (g, x) a' t) as (t' & Ht' & Hag).
          - reflexivity.
          - apply alike_refl.
          - intros ds. eapply Hs; [exact Hp' | reflexivity].
          - exact Ht.
          - exists t'. split; [|exact Hag]. apply in_each. exists b', (g, x), a'. auto. }
        assert (Parts : forall b y a, xs = b ++ y :: a -> forallb (fun b => normal (snd b)) xs = true ->
                  normal (snd y) = true /\ forallb (fun b => normal (snd b)) (b ++ a) = true).
        { intros b0 y a0 -> Hx. rewrite forallb_app in *. cbn [forallb] in Hx. rewrite !andb_true_iff in *. tauto. }
        assert (All : forallb (fun b => normal (snd b)) xs = true).
        { destruct H as [(-> & _) | [(-> & _) | (r & -> & _)]]; cbn [normal] in Na; rewrite !andb_true_iff in Na;
          tauto. }
        intros e K S u Hu. assert (Nu := goes_normal Hu Na).
        destruct H as [(-> & ->) | [(-> & ->) | (r & -> & ->)]].
        + apply goes_parts in Hu. destruct Hu as [Hu | (f & r1 & v & [] & _)]. cbn [own] in Hu.
          destruct (Choosing e K S (fun _ r => r) u) as (t' & Ht' & Hag); [| exact Hu |].
          * intros y b0 a0 b' a' Hp' x E ds. apply up_refl, normal_given. apply (Parts _ _ _ E All).
          * exists t'. split; [apply Itself; exact Ht' | exact Hag].
        + apply goes_parts in Hu. destruct Hu as [Hu | (f & r1 & v & [] & _)]. cbn [own] in Hu.
          destruct (Choosing e K S (fun others r => branch_of r others) u) as (t' & Ht' & Hag); [| exact Hu |].
          * intros y b0 a0 b' a' Hp' x E ds. destruct (Parts _ _ _ E All) as [Nx No]. cbn [snd] in Nx.
            assert (Ng := normal_given ds x Nx). unfold branch_of.
            destruct (b0 ++ a0) as [|z rest] eqn:E0.
            -- apply Permutation_nil in Hp'. rewrite Hp'. apply up_refl. exact Ng.
            -- destruct (b' ++ a') as [|z' rest'] eqn:E1.
               { symmetry in Hp'. apply Permutation_nil in Hp'. discriminate. }
               left. split.
               { cbn [normal length Nat.leb]. rewrite Ng. exact No. }
               exists (z :: rest), (z' :: rest'). split; [exact Hp'|]. right. right. exists (given ds x). auto.
          * exists t'. split; [apply Itself; exact Ht' | exact Hag].
        + change (Branch r xs) with (plug (Branch_of xs) r) in Hu.
          apply goes_plug in Hu; [|reflexivity]. destruct Hu as [[] | (v & Hv & Hu)].
          assert (Step : forall u', In u' (lift (Branch_of ys) K v) -> goes e K S (Branch r ys) u').
          { intros u' Hu'. change (Branch r ys) with (plug (Branch_of ys) r).
            eapply Within; [eapply goes_similar; [exact Hv|] | exact Hu'].
            apply enter_alike; [reflexivity | exact A1 | exact A3]. }
          destruct v as [l S1 [x | | m | x] E]; destruct Hu as [<- | []]; (eexists; split; [apply Step; left;
            reflexivity|]);
            (split; [reflexivity | split; [reflexivity|]]); auto.
          * left. split; [exact Nu|]. exists xs, ys. split; [exact Hp|]. right. right. exists x. auto.
          * assert (Hl := Permutation_length Hp). cbn [next_normal on_ok] in Nu. unfold all_of in *.
            destruct xs as [|z [|z' rest]].
            -- apply Permutation_nil in Hp. rewrite Hp. apply up_refl. exact Nu.
            -- apply Permutation_length_1_inv in Hp. rewrite Hp. apply up_refl. exact Nu.
            -- destruct ys as [|y [|y' rest']]; try discriminate Hl. left. split; [exact Nu|].
               exists (z :: z' :: rest), (y :: y' :: rest'). auto. }
    split; [|split].
    - intros Hn. apply G. split; [exact Hn|]. exists bs, bs'. auto.
    - intros Hn. apply G. split; [exact Hn|]. exists bs, bs'. auto.
    - intros r Hn. apply G. split; [exact Hn|]. exists bs, bs'. split; [exact H|]. right. right. exists r. auto.
  Qed.

  (** [(oneOf { when { g } then t ... }) >> t' = oneOf { when { g } then t >> t' ... }] *)
  Theorem choice_sequence bs t :
    normal (One_of bs) = true -> normal t = true -> forallb (fun b => plain (snd b)) bs = true ->
    bisimilar (sequence (One_of bs) t) (One_of (map (fun b => (fst b, sequence (snd b) t)) bs)).
  Proof.
    intros Hn Ht Hp. set (ext := fun b : branch => (fst b, sequence (snd b) t)).
    apply (@by_relation _ _ (fun a b => a = Sequence (One_of bs) t /\ b = One_of (map ext bs))); [|auto].
    intros a b (-> & ->). cbn [normal] in Hn. rewrite andb_true_iff in Hn. destruct Hn as [Hl Hb].
    assert (Hb' : forall y, In y bs -> normal (sequence (snd y) t) = true).
    { intros y Hy. apply normal_sequence; [|exact Ht]. rewrite forallb_forall in Hb. auto. }
    assert (Names : forall X (f : residual -> list X), (forall a b, alike (f (sequence a b)) (f a ++ f b)) ->
              alike (flat_map (fun b => f (snd b)) bs ++ f t) (flat_map (fun b => f (snd b)) (map ext bs))).
    { intros X f Hf x. rewrite in_app_iff, !in_flat_map. split.
      - intros [(y & Hy & Hx) | Hx].
        + exists (ext y). split; [apply in_map; exact Hy|]. apply Hf, in_app_iff. auto.
        + destruct bs as [|y ys]; [discriminate|]. exists (ext y). split; [left;
          reflexivity|]. apply Hf, in_app_iff. auto.
      - intros (y & Hy & Hx). apply in_map_iff in Hy. destruct Hy as (z & <- & Hz). cbn [ext snd] in Hx.
        apply Hf, in_app_iff in Hx. destruct Hx as [Hx | Hx]; eauto. }
    assert (F : face (Sequence (One_of bs) t) (One_of (map ext bs))).
    { split.
      - apply (Names _ names alike_names_sequence).
      - apply alike_refl.
      - apply (Names _ numbers alike_numbers_sequence).
      - cbn [normal is_sequence negb andb]. rewrite !andb_true_iff. auto.
      - cbn [normal]. apply andb_true_iff. split; [rewrite map_length; exact Hl|]. apply forallb_forall. intros y Hy.
        apply in_map_iff in Hy. destruct Hy as (z & <- & Hz). apply Hb'. exact Hz.
      - apply alike_refl.
      - reflexivity. }
    assert (Plain : forall y ds, In y bs -> given ds (snd y) = snd y).
    { intros y ds Hy. apply given_plain. rewrite forallb_forall in Hp. auto. }
    assert (Plain' : forall y ds, In y bs -> given ds (sequence (snd y) t) = sequence (snd y) t).
    { intros y ds Hy. destruct (snd y); reflexivity. }
    split; [exact F | split; intros e K S u Hu].
    - change (Sequence (One_of bs) t) with (plug (In_sequence t) (One_of bs)) in Hu.
      apply goes_plug in Hu; [|reflexivity]. destruct Hu as [[] | (v & Hv & Hu)].
      apply goes_parts in Hv. destruct Hv as [Hv | (f & r1 & w & [] & _)]. cbn [own] in Hv.
      apply in_each in Hv. destruct Hv as (b0 & y & a0 & -> & Hv). cbn [app] in Hv.
      assert (Hy : In y (b0 ++ y :: a0)) by apply in_elt.
      assert (Step : forall u', In u' (choose e K S (fun _ r => r) (map ext b0) (ext y) (map ext a0)) ->
                goes e K S (One_of (map ext (b0 ++ y :: a0))) u').
      { intros u' Hu'. apply Itself. cbn [own]. apply in_each. exists (map ext b0), (ext y), (map ext a0).
        rewrite map_app. auto. }
      unfold choose, guarded, coded, breaks in Hv, Step. destruct e; [contradiction|].
      change (runs (fst y) [] (enter (In_sequence t) K) S) with (runs (fst y) [] K S) in Hv. cbn [ext fst snd] in Step.
      destruct (runs (fst y) [] K S) as [x s N0 ds | m ds | m ds | m s N0 ds |]; try contradiction;
        [destruct (truth x) as [[]|] | destruct (is_unknown m) | |]; try contradiction; destruct Hv as [<- | []];
        destruct Hu as [<- | []]; (eexists; split; [apply Step; left; reflexivity|]); try (cbn; auto; fail).
      split; [reflexivity | split; [rewrite keys_sequence; reflexivity|]].
      change (up (fun a b => a = Sequence (One_of (b0 ++ y :: a0)) t /\ b = One_of (map ext (b0 ++ y :: a0)))
                (sequence (given ds (snd y)) t) (given ds (sequence (snd y) t))).
      rewrite (Plain y ds Hy), (Plain' y ds Hy). apply up_refl, Hb', Hy.
    - apply goes_parts in Hu. destruct Hu as [Hu | (f & r1 & w & [] & _)]. cbn [own] in Hu.
      apply in_each in Hu. destruct Hu as (b0 & y0 & a0 & E & Hu). cbn [app] in Hu.
      apply map_eq_app in E. destruct E as (b1 & rest & -> & <- & E).
      destruct rest as [|y a1]; [discriminate|]. injection E as <- <-.
      assert (Hy : In y (b1 ++ y :: a1)) by apply in_elt.
      assert (Step : forall v u', In v (choose e K S (fun _ r => r) b1 y a1) -> In u' (lift (In_sequence t) K v) ->
                goes e K S (Sequence (One_of (b1 ++ y :: a1)) t) u').
      { intros v u' Hv Hu'. change (Sequence (One_of (b1 ++ y :: a1)) t) with (plug (In_sequence t) (One_of (b1 ++ y
        :: a1))).
        eapply Within; [|exact Hu']. apply Itself. cbn [own]. apply in_each. exists b1, y, a1. auto. }
      unfold choose, guarded, coded, breaks in Hu, Step. destruct e; [contradiction|]. cbn [ext fst snd] in Hu.
      destruct (runs (fst y) [] K S) as [x s N0 ds | m ds | m ds | m s N0 ds |]; try contradiction;
        [destruct (truth x) as [[]|] | destruct (is_unknown m) | |]; try contradiction; destruct Hu as [<- | []];
        (eexists; split; [eapply Step; [left; reflexivity | left; reflexivity]|]); try (cbn; auto; fail).
      split; [reflexivity | split; [rewrite keys_sequence; reflexivity|]].
      change (up (fun b a => a = Sequence (One_of (b1 ++ y :: a1)) t /\ b = One_of (map ext (b1 ++ y :: a1)))
                (given ds (sequence (snd y) t)) (sequence (given ds (snd y)) t)).
      rewrite (Plain y ds Hy), (Plain' y ds Hy). apply up_refl, Hb', Hy.
  Qed.

  (** {1 A cut of parallel parts} *)

  (** The guard does not ask which vehicles are held. *)
  Definition asks_no_held (g : code) : Prop :=
    forall K K' S, world_of K = world_of K' -> runs g [] K S = runs g [] K' S.

  Section Side_by_side.
  Hypothesis commute : ends_commute.

  Lemma without_both a b S : without (run_of b) (without (run_of a) S) = without (flat_map run_of (flat a ++ flat b)) S.
  Proof.
    rewrite without_twice. apply without_alike. intros v.
    rewrite flat_map_app, !(@through_flat _ _ _ _ through_run_of), !in_app_iff. tauto.
  Qed.

  Lemma run_of_two a b : normal a = true -> normal b = true ->
    alike (run_of (parallel [a; b])) (flat_map run_of (flat a ++ flat b)).
  Proof. intros Ha Hb. rewrite (parallel_two Ha Hb), through_run_of. apply alike_refl. Qed.

  (** The steps of [a | b] are those of [a] beside [b], and of [b] beside [a]. *)
  Definition of_left (b : residual) (v : transition) : transition :=
    match v with
    | By l S1 (Next a) E => By l S1 (Next (parallel [a; b])) E
    | By l S1 Ok E => By l S1 (Next b) E
    | By l S1 (Err m) E => By l (does (ensured b) (without (run_of b) S1)) (Err m) E
    | By l S1 (Ends x) E => By l S1 (Ends x) E
    end.
  Definition of_right (a : residual) (v : transition) : transition :=
    match v with
    | By l S1 (Next b) E => By l S1 (Next (parallel [a; b])) E
    | By l S1 Ok E => By l S1 (Next a) E
    | By l S1 (Err m) E => By l (does (ensured a) (without (run_of a) S1)) (Err m) E
    | By l S1 (Ends x) E => By l S1 (Ends x) E
    end.

  Lemma agree_eq_trans t t1 t2 : agree eq t t1 -> agree eq t1 t2 -> agree eq t t2.
  Proof. intros H1 H2. eapply agree_eq_both; [exact H1 | exact H2 | apply agree_self]. Qed.

  Lemma agree_eq_sym t t1 : agree eq t t1 -> agree eq t1 t.
  Proof.
    destruct t as [l S1 o E], t1 as [l1 S2 o1 E1]. intros (H1 & H2 & H3). split; [auto | split; [auto|]].
    destruct o, o1; auto.
  Qed.

  Lemma surround_left b v : normal b = true -> next_normal v -> agree eq (surround [] (flat b) v) (of_left b v).
  Proof.
    intros Hb Nv. destruct v as [l S1 [x | | m | x] E]; cbn [surround of_left app].
    - split; [reflexivity | split; [reflexivity|]]. rewrite (parallel_two Nv Hb). reflexivity.
    - split; [reflexivity | split; [reflexivity|]]. apply parallel_flat. exact Hb.
    - split; [reflexivity | split; [|reflexivity]].
      rewrite (@through_flat _ _ _ _ through_run_of), (@through_flat _ _ _ _ through_ensured). reflexivity.
    - cbn. auto.
  Qed.

  Lemma surround_right a v : normal a = true -> next_normal v -> agree eq (surround (flat a) [] v) (of_right a v).
  Proof.
    intros Ha Nv. destruct v as [l S1 [x | | m | x] E]; cbn [surround of_right]; rewrite ?app_nil_r.
    - split; [reflexivity | split; [reflexivity|]]. rewrite (parallel_two Ha Nv). reflexivity.
    - split; [reflexivity | split; [reflexivity|]]. apply parallel_flat. exact Ha.
    - split; [reflexivity | split; [|reflexivity]].
      rewrite (@through_flat _ _ _ _ through_run_of), (@through_flat _ _ _ _ through_ensured). reflexivity.
    - cbn. auto.
  Qed.

  Lemma around_one r : normal r = true -> around [] (flat r) /\ around (flat r) [].
  Proof.
    intros Hr. destruct (normal_flat r Hr) as [H1 H2]. unfold around. rewrite app_nil_r. cbn [app]. auto.
  Qed.

  Lemma goes_two a b e K S u : normal a = true -> normal b = true -> goes e K S (parallel [a; b]) u ->
    (exists v, goes e (enter (Beside [] (flat b)) K) S a v /\ agree eq u (of_left b v)) \/
    (exists v, goes e (enter (Beside (flat a) []) K) S b v /\ agree eq u (of_right a v)).
  Proof.
    intros Ha Hb Hu. destruct (around_one Ha) as [A1 A2], (around_one Hb) as [B1 B2].
    rewrite (parallel_two Ha Hb) in Hu. apply goes_parts in Hu. destruct Hu as [[] | (f & r & v & Hp & Hv & Hu)].
    apply in_parts in Hp. destruct f; try discriminate Hp. injection Hp as Hp. rewrite lift_beside in Hu.
    destruct Hu as [<- | []]. symmetry in Hp.
    destruct (@three_ways _ before r after [] (flat a) (flat b) Hp) as [(c & E & _) | [(b1 & a1 & F & ->
      & ->) | (c & F & ->)]].
    - destruct before; discriminate.
    - left. destruct (hole_forward commute B1 Ha F Hv) as (w & Hw & Hag). exists w. split; [exact Hw|].
      eapply agree_eq_trans; [exact Hag|]. apply surround_left; [exact Hb | exact (goes_normal Hw Ha)].
    - right. cbn [app] in Hv |- *. replace after with (after ++ []) in Hv |- * by apply app_nil_r.
      destruct (hole_forward commute A2 Hb F Hv) as (w & Hw & Hag). exists w. split; [exact Hw|].
      eapply agree_eq_trans; [exact Hag|]. apply surround_right; [exact Ha | exact (goes_normal Hw Hb)].
  Qed.

  Lemma goes_left a b e K S v : normal a = true -> normal b = true -> goes e (enter (Beside [] (flat b)) K) S a v ->
    exists u, goes e K S (parallel [a; b]) u /\ agree eq u (of_left b v).
  Proof.
    intros Ha Hb Hv. destruct (around_one Hb) as [B1 _]. destruct (hole_backward commute B1 Ha Hv) as (u & Hu & Hag).
    exists u. split; [rewrite (parallel_two Ha Hb); exact Hu|]. eapply agree_eq_trans; [apply agree_eq_sym; exact Hag|].
    apply surround_left; [exact Hb | exact (goes_normal Hv Ha)].
  Qed.

  Lemma goes_right a b e K S v : normal a = true -> normal b = true -> goes e (enter (Beside (flat a) []) K) S b v ->
    exists u, goes e K S (parallel [a; b]) u /\ agree eq u (of_right a v).
  Proof.
    intros Ha Hb Hv. destruct (around_one Ha) as [_ A2]. destruct (hole_backward commute A2 Hb Hv) as (u & Hu & Hag).
    exists u. split.
    - rewrite (parallel_two Ha Hb). unfold hole in Hu. rewrite app_nil_r in Hu. exact Hu.
    - eapply agree_eq_trans; [apply agree_eq_sym; exact Hag|]. apply surround_right;
      [exact Ha | exact (goes_normal Hv Hb)].
  Qed.

  Lemma until_beside k g B A B' A' K :
    alike (flat_map names (B ++ A)) (flat_map names (B' ++ A')) ->
    alike (flat_map numbers (B ++ A)) (flat_map numbers (B' ++ A')) ->
    similar (enter (Beside B A) (enter (Body_until k g) K)) (enter (Body_until k g) (enter (Beside B' A') K)).
  Proof.
    intros Hn Hi. assert (A0 : is_around (Body_until k g) [] []) by (repeat split; apply alike_refl).
    eapply similar_trans; [apply enter_similar, enter_none, A0|].
    eapply similar_trans; [|apply similar_sym, enter_none, A0]. apply enter_alike; [reflexivity | exact Hn | exact Hi].
  Qed.

  (** The steps of [until], by itself or by its part. *)
  Lemma goes_until e K S k g r u : goes e K S (Until k g r) u <->
    In u (own e K S (Until k g r)) \/ exists v, goes e (enter (Body_until k g) K) S r v /\
      In u (lift (Body_until k g) K v).
  Proof. change (Until k g r) with (plug (Body_until k g) r). apply goes_plug. reflexivity. Qed.

  (** [assure { g } run (t | t') = (assure { g } run t) | (assure { g } run t')], if g does not ask for held vehicles *)
  Theorem assure_parallel at_site g a b : asks_no_held g -> normal a = true -> normal b = true ->
    bisimilar (Until (Fails at_site) g (parallel [a; b]))
              (parallel [Until (Fails at_site) g a; Until (Fails at_site) g b]).
  Proof.
    intros Hg Ha Hb.
    set (cutting := fun r => Until (Fails at_site) g r).
    apply (@by_relation _ _ (fun x y => exists a b, normal a = true /\ normal b = true /\
      x = cutting (parallel [a; b]) /\ y = parallel [cutting a; cutting b])); [|exists a, b; auto].
    clear a b Ha Hb. intros x y (a & b & Ha & Hb & -> & ->).
    assert (Na : normal (cutting a) = true) by exact Ha. assert (Nb : normal (cutting b) = true) by exact Hb.
    assert (N2 : forall p q, normal p = true -> normal q = true -> normal (parallel [p; q]) = true).
    { intros p q Hp Hq. apply normal_parallel; [discriminate|]. cbn. rewrite Hp, Hq. reflexivity. }
    assert (Through : forall X (f : residual -> list X), through f -> (forall r, f (cutting r) = f r) ->
      alike (f (cutting (parallel [a; b]))) (f (parallel [cutting a; cutting b]))).
    { intros X f Hf Hc. rewrite Hc, !(through_parallel _ _ _ Hf). cbn [flat_map]. rewrite !Hc. apply alike_refl. }
    assert (F : face (cutting (parallel [a; b])) (parallel [cutting a; cutting b])).
    { split.
      - apply Through; [apply through_names | reflexivity].
      - apply Through; [apply through_run_of | reflexivity].
      - apply Through; [apply through_numbers | reflexivity].
      - exact (N2 a b Ha Hb).
      - apply N2; assumption.
      - apply Through; [apply through_keys | reflexivity].
      - intros S. cbn [cutting ensured]. rewrite !(through_parallel _ _ _ through_ensured). reflexivity. }
    assert (Ends : ensured (parallel [a; b]) = ensured a ++ ensured b)
      by (rewrite (through_parallel _ _ _ through_ensured); cbn [flat_map]; rewrite app_nil_r; reflexivity).
    assert (CutA : forall S, does (ensured (cutting b)) (without (run_of (cutting b))
      (does (ensured a) (without (run_of a) S))) = does (ensured (parallel [a; b])) (without (run_of (parallel [a;
      b])) S)).
    { intros S. change (ensured (cutting b)) with (ensured b). change (run_of (cutting b)) with (run_of b).
      change (without (run_of b) (does (ensured a) (without (run_of a) S)))
        with (does (ensured a) (without (run_of b) (without (run_of a) S))).
      rewrite Ends, does_app, without_both. do 2 f_equal. apply without_alike, alike_sym.
      apply run_of_two; assumption. }
    assert (CutB : forall S, does (ensured (cutting a)) (without (run_of (cutting a))
      (does (ensured b) (without (run_of b) S))) = does (ensured (parallel [a; b])) (without (run_of (parallel [a;
      b])) S)).
    { intros S. change (ensured (cutting a)) with (ensured a). change (run_of (cutting a)) with (run_of a).
      change (without (run_of a) (does (ensured b) (without (run_of b) S)))
        with (does (ensured b) (without (run_of a) (without (run_of b) S))).
      rewrite <- does_app, (does_permuted commute (Permutation_app_comm (ensured b) (ensured a)))
        by (rewrite forallb_app, (ensured_allowed Ha), (ensured_allowed Hb); reflexivity).
      rewrite <- Ends. f_equal. rewrite without_twice. apply without_alike. intros v.
      rewrite (run_of_two Ha Hb v), flat_map_app, !(@through_flat _ _ _ _ through_run_of), !in_app_iff. tauto. }
    assert (Names : forall X (f : residual -> list X) r, through f -> f (cutting r) = f r ->
              alike (flat_map f (flat r)) (flat_map f (flat (cutting r)))).
    { intros X f r Hf Hc. rewrite !(@through_flat _ _ _ _ Hf), Hc. apply alike_refl. }
    assert (CtxA : forall K, similar (enter (Beside [] (flat b)) (enter (Body_until (Fails at_site) g) K))
                     (enter (Body_until (Fails at_site) g) (enter (Beside [] (flat (cutting b))) K))).
    { intros K. apply until_beside; cbn [app];
        [apply Names; [apply through_names | reflexivity] | apply Names; [apply through_numbers | reflexivity]]. }
    assert (CtxB : forall K, similar (enter (Beside (flat a) []) (enter (Body_until (Fails at_site) g) K))
                     (enter (Body_until (Fails at_site) g) (enter (Beside (flat (cutting a)) []) K))).
    { intros K. apply until_beside; rewrite !app_nil_r;
        [apply Names; [apply through_names | reflexivity] | apply Names; [apply through_numbers | reflexivity]]. }
    split; [exact F | split; intros e K S t Ht].
    - apply goes_until in Ht. destruct Ht as [Ht | (w & Hw & Ht)].
      + assert (Step : forall v, In v (own e (enter (Beside [] (flat (cutting b))) K) S (cutting a)) ->
                  exists u, goes e K S (parallel [cutting a; cutting b]) u /\ agree eq u (of_left (cutting b) v)).
        { intros v Hv. apply goes_left; [exact Na | exact Nb | apply Itself; exact Hv]. }
        unfold cutting in Step at 2. cbn [own] in Ht, Step. unfold guarded, coded, breaks in Ht, Step.
        destruct e; [contradiction|].
        rewrite (Hg (enter (Beside [] (flat (cutting b))) K) K S eq_refl) in Step.
        destruct (runs g [] K S) as [x s N0 ds | m ds | m ds | m s N0 ds |]; try contradiction;
          [destruct (truth x) as [[]|] | destruct (is_unknown m) | |]; try contradiction; destruct Ht as [<- | []];
          (edestruct Step as (u & Hu & Hag); [left; reflexivity|]; exists u; split; [exact Hu|];
           apply agree_eq_sym in Hag; destruct u as [l2 S2 o2 E2]; destruct Hag as (<- & <- & Ho); cbn [of_left] in Ho;
           cbn [agree]; rewrite ?CutA; destruct o2; try contradiction; auto).
      + destruct (goes_two Ha Hb Hw) as [(v & Hv & Hag) | (v & Hv & Hag)].
        * assert (Nv := goes_normal Hv Ha). eapply goes_similar in Hv; [|apply CtxA].
          assert (Step : forall v1, In v1 (lift (Body_until (Fails at_site) g) (enter (Beside [] (flat (cutting b)))
            K) v) ->
                    exists u, goes e K S (parallel [cutting a; cutting b]) u /\ agree eq u (of_left (cutting b) v1)).
          { intros v1 Hv1. apply goes_left; [exact Na | exact Nb|]. apply goes_until. right. exists v. auto. }
          destruct v as [l S1 [p | | m | p] E], w as [l1 S2 o1 E1]; destruct Hag as (-> & -> & Ho); cbn [of_left] in Ho;
            destruct o1; try contradiction; subst; destruct Ht as [<- | []];
            (edestruct Step as (u & Hu & Hag); [left; reflexivity|]; exists u; split; [exact Hu|];
             apply agree_eq_sym in Hag; destruct u as [l2 S3 o2 E2]; destruct Hag as (<- & <- & Ho);
               cbn [of_left] in Ho;
             destruct o2; try contradiction; cbn [agree]; split; [reflexivity | split; [reflexivity|]]); auto.
          -- subst. left. exists p, b. auto.
          -- subst. right. apply bisimilar_refl. exact Nb.
        * assert (Nv := goes_normal Hv Hb). eapply goes_similar in Hv; [|apply CtxB].
          assert (Step : forall v1, In v1 (lift (Body_until (Fails at_site) g) (enter (Beside (flat (cutting a)) [])
            K) v) ->
                    exists u, goes e K S (parallel [cutting a; cutting b]) u /\ agree eq u (of_right (cutting a) v1)).
          { intros v1 Hv1. apply goes_right; [exact Na | exact Nb|]. apply goes_until. right. exists v. auto. }
          destruct v as [l S1 [p | | m | p] E], w as [l1 S2 o1 E1]; destruct Hag as (-> & -> & Ho);
            cbn [of_right] in Ho;
            destruct o1; try contradiction; subst; destruct Ht as [<- | []];
            (edestruct Step as (u & Hu & Hag); [left; reflexivity|]; exists u; split; [exact Hu|];
             apply agree_eq_sym in Hag; destruct u as [l2 S3 o2 E2]; destruct Hag as (<- & <- & Ho);
               cbn [of_right] in Ho;
             destruct o2; try contradiction; cbn [agree]; split; [reflexivity | split; [reflexivity|]]); auto.
          -- subst. left. exists a, p. auto.
          -- subst. right. apply bisimilar_refl. exact Na.
    - destruct (goes_two Na Nb Ht) as [(w & Hw & Hag) | (w & Hw & Hag)].
      + apply goes_until in Hw. destruct Hw as [Hw | (v & Hv & Hw)].
        * assert (Step : forall v, In v (own e K S (cutting (parallel [a; b]))) -> goes e K S (cutting (parallel [a;
          b])) v)
            by (intros; apply Itself; assumption).
          unfold cutting in Step at 1. cbn [own] in Hw, Step. unfold guarded, coded, breaks in Hw, Step.
          destruct e; [contradiction|]. rewrite (Hg (enter (Beside [] (flat (cutting b))) K) K S eq_refl) in Hw.
          destruct (runs g [] K S) as [x s N0 ds | m ds | m ds | m s N0 ds |]; try contradiction;
            [destruct (truth x) as [[]|] | destruct (is_unknown m) | |]; try contradiction; destruct Hw as [<- | []];
            destruct t as [l2 S2 o2 E2]; destruct Hag as (-> & -> & Ho); cbn [of_left] in Ho;
            destruct o2; try contradiction; subst; rewrite ?CutA;
            (eexists; split; [apply Step; left; reflexivity | cbn; auto]).
        * assert (Nv := goes_normal Hv Ha). eapply goes_similar in Hv; [|apply similar_sym, CtxA].
          destruct (goes_left Ha Hb Hv) as (q & Hq & Haq).
          assert (Step : forall u, In u (lift (Body_until (Fails at_site) g) K q) ->
            goes e K S (cutting (parallel [a; b])) u).
          { intros u Hu. apply goes_until. right. exists q. auto. }
          destruct v as [l S1 [p | | m | p] E], q as [l1 S2 o1 E1]; destruct Haq as (-> & -> & Ho1);
            cbn [of_left] in Ho1;
            destruct o1; try contradiction; subst; destruct Hw as [<- | []];
            destruct t as [l2 S3 o2 E2]; destruct Hag as (-> & -> & Ho); cbn [of_left] in Ho;
            destruct o2; try contradiction; subst;
            (eexists; split; [apply Step; left; reflexivity | split; [reflexivity | split; [reflexivity|]]]); auto.
          -- left. exists p, b. auto.
          -- right. apply bisimilar_refl. exact Nb.
      + apply goes_until in Hw. destruct Hw as [Hw | (v & Hv & Hw)].
        * assert (Step : forall v, In v (own e K S (cutting (parallel [a; b]))) -> goes e K S (cutting (parallel [a;
          b])) v)
            by (intros; apply Itself; assumption).
          unfold cutting in Step at 1. cbn [own] in Hw, Step. unfold guarded, coded, breaks in Hw, Step.
          destruct e; [contradiction|]. rewrite (Hg (enter (Beside (flat (cutting a)) []) K) K S eq_refl) in Hw.
          destruct (runs g [] K S) as [x s N0 ds | m ds | m ds | m s N0 ds |]; try contradiction;
            [destruct (truth x) as [[]|] | destruct (is_unknown m) | |]; try contradiction; destruct Hw as [<- | []];
            destruct t as [l2 S2 o2 E2]; destruct Hag as (-> & -> & Ho); cbn [of_right] in Ho;
            destruct o2; try contradiction; subst; rewrite ?CutB;
            (eexists; split; [apply Step; left; reflexivity | cbn; auto]).
        * assert (Nv := goes_normal Hv Hb). eapply goes_similar in Hv; [|apply similar_sym, CtxB].
          destruct (goes_right Ha Hb Hv) as (q & Hq & Haq).
          assert (Step : forall u, In u (lift (Body_until (Fails at_site) g) K q) ->
            goes e K S (cutting (parallel [a; b])) u).
          { intros u Hu. apply goes_until. right. exists q. auto. }
          destruct v as [l S1 [p | | m | p] E], q as [l1 S2 o1 E1]; destruct Haq as (-> & -> & Ho1);
            cbn [of_right] in Ho1;
            destruct o1; try contradiction; subst; destruct Hw as [<- | []];
            destruct t as [l2 S3 o2 E2]; destruct Hag as (-> & -> & Ho); cbn [of_right] in Ho;
            destruct o2; try contradiction; subst;
            (eexists; split; [apply Step; left; reflexivity | split; [reflexivity | split; [reflexivity|]]]); auto.
          -- left. exists a, p. auto.
          -- right. apply bisimilar_refl. exact Na.
  Qed.

  End Side_by_side.

  (** {1 Rounds that begin in the middle} *)

  Definition turned (t u a b : residual) : Prop :=
    exists x, normal x = true /\ a = Repeat (sequence x u) None None (sequence t u) /\
      b = Repeat x None None (sequence u t).

  Lemma turned_step t u a b : normal t = true -> normal u = true -> turned t u a b ->
    let Q := fun a b => turned t u a b \/ turned u t b a in
    face a b /\ simulates (up Q) a b /\ simulates (up (fun a b => Q b a)) b a.
  Proof.
    intros Ht Hu (x & Hx & -> & ->) Q. set (tu := sequence t u). set (ut := sequence u t).
    assert (Nxu : normal (sequence x u) = true) by (apply normal_sequence; assumption).
    assert (Ntu : normal tu = true) by (apply normal_sequence; assumption).
    assert (Nut : normal ut = true) by (apply normal_sequence; assumption).
    assert (A1 : forall i, In i (names u ++ names tu) <-> In i (names ut)).
    { intros i. unfold tu, ut. rewrite in_app_iff, !names_sequence. tauto. }
    assert (A3 : forall i, In i (numbers u ++ numbers tu) <-> In i (numbers ut)).
    { intros i. unfold tu, ut. rewrite in_app_iff, !(alike_numbers_sequence _ _ i), !in_app_iff. tauto. }
    assert (F : face (Repeat (sequence x u) None None tu) (Repeat x None None ut)).
    { split.
      - intros i. cbn [names]. rewrite !in_app_iff, names_sequence. specialize (A1 i). rewrite in_app_iff in A1. tauto.
      - change (alike (run_of (sequence x u)) (run_of x)). rewrite run_of_sequence. apply alike_refl.
      - intros i. cbn [numbers]. rewrite !in_app_iff, (alike_numbers_sequence x u i), in_app_iff. specialize (A3 i).
        rewrite in_app_iff in A3. tauto.
      - cbn [normal some_left]. rewrite Nxu, Ntu. reflexivity.
      - cbn [normal some_left]. rewrite Hx, Nut. reflexivity.
      - change (alike (keys (sequence x u)) (keys x)). rewrite keys_sequence. apply alike_refl.
      - intros S. cbn [ensured]. rewrite ensured_sequence. reflexivity. }
    assert (Ctx : forall K, similar (enter (In_sequence u) (enter (Round_of None None tu) K)) (enter (Round_of None
      None ut) K)).
    { intros K.
      assert (P1 : is_around (In_sequence u) (names u) (numbers u)) by (repeat split; apply alike_refl).
      assert (P2 : is_around (Round_of None None tu) (names tu) (numbers tu)) by (repeat split; apply alike_refl).
      assert (P3 : is_around (Round_of None None ut) (names u ++ names tu) (numbers u ++ numbers tu))
        by (split; [reflexivity | split; [apply alike_sym; exact A1 | apply alike_sym; exact A3]]).
      eapply enter_two; eassumption. }
    assert (Turn : turned u t (Repeat ut None None ut) (Repeat u None None tu)) by (exists u; auto).
    split; [exact F | split; intros e K S w Hw].
    - change (Repeat (sequence x u) None None tu) with (plug (Round_of None None tu) (sequence x u)) in Hw.
      apply goes_plug in Hw; [|reflexivity]. destruct Hw as [[] | (w1 & Hw1 & Hw)].
      apply goes_sequence in Hw1. destruct Hw1 as (v & Hv & Hw1). assert (Nv := goes_normal Hv Hx).
      eapply goes_similar in Hv; [|apply Ctx].
      assert (Step : forall u', In u' (lift (Round_of None None ut) K v) -> goes e K S (Repeat x None None ut) u').
      { intros u' Hu'. change (Repeat x None None ut) with (plug (Round_of None None ut) x). eapply Within;
        eassumption. }
      destruct v as [l S1 [y | | m | y] E]; destruct Hw1 as [<- | []]; destruct Hw as [<- | []];
        (eexists; split; [apply Step; left; reflexivity|]); (split; [reflexivity | split; [unfold tu, ut; rewrite
          ?keys_sequence; reflexivity|]]); auto.
      + left. left. exists y. auto.
      + left. right. exact Turn.
    - change (Repeat x None None ut) with (plug (Round_of None None ut) x) in Hw.
      apply goes_plug in Hw; [|reflexivity]. destruct Hw as [[] | (v & Hv & Hw)]. assert (Nv := goes_normal Hv Hx).
      eapply goes_similar in Hv; [|apply similar_sym, Ctx].
      assert (Step : forall v1 u', In v1 (lift (In_sequence u) (enter (Round_of None None tu) K) v) ->
        In u' (lift (Round_of None None tu) K v1) -> goes e K S (Repeat (sequence x u) None None tu) u').
      { intros v1 u' Hv1 Hu'.
        change (Repeat (sequence x u) None None tu) with (plug (Round_of None None tu) (sequence x u)).
        eapply Within; [apply goes_sequence; exists v; split; [exact Hv | exact Hv1] | exact Hu']. }
      destruct v as [l S1 [y | | m | y] E]; destruct Hw as [<- | []];
        (eexists; split; [eapply Step; [left; reflexivity | left; reflexivity]|]);
        (split; [reflexivity | split; [unfold tu, ut; rewrite ?keys_sequence; reflexivity|]]); auto.
      + left. left. exists y. auto.
      + left. right. exact Turn.
  Qed.

  (** [repeat (t >> t') = t >> repeat (t' >> t)] *)
  Theorem repeat_turned t u : normal t = true -> normal u = true ->
    bisimilar (Repeat (sequence t u) None None (sequence t u))
              (sequence t (Repeat (sequence u t) None None (sequence u t))).
  Proof.
    intros Ht Hu. apply (bisimilar_trans (r' := Repeat t None None (sequence u t))).
    - apply (@by_relation _ _ (fun a b => turned t u a b \/ turned u t b a)); [|left; exists t; auto].
      intros a b [H | H].
      + apply turned_step; assumption.
      + destruct (turned_step Hu Ht H) as (F & S1 & S2). split; [apply face_sym; exact F | split].
        * eapply simulates_more; [|exact S2]. intros p q [Hpq | Hpq]; [left; tauto | right; exact Hpq].
        * eapply simulates_more; [|exact S1]. intros p q [Hpq | Hpq]; [left; tauto | right; exact Hpq].
    - apply (@repeat_unrolled t None (sequence u t)); [reflexivity | exact Ht | apply normal_sequence; assumption].
  Qed.

  (** {1 Endless rounds} *)

  (** What comes after endless rounds makes no difference, if it names nothing else and has no timers of its own. *)
  Lemma endless_rounds f t : kind f = (0, []) -> is_beside f = false ->
    (forall v, In v (frame_names f) -> In v (names t)) -> (forall i, In i (frame_numbers f) -> In i (numbers t)) ->
    (forall r, normal r = true -> normal (plug f (Repeat r None None t)) = true) ->
    (forall r, alike (names (plug f r)) (names r ++ frame_names f) /\ run_of (plug f r) = run_of r /\
       alike (numbers (plug f r)) (numbers r ++ frame_numbers f) /\ keys (plug f r) = keys r /\
       ensured (plug f r) = ensured r) ->
    (forall e K S r x, ~ In x (own e K S (plug f r))) ->
    (forall r, replug f (Repeat r None None t) = plug f (Repeat r None None t)) ->
    (forall K l S1 m E, lift f K (By l S1 (Err m) E) = [By l S1 (Err m) E]) ->
    forall r, normal r = true -> normal t = true -> bisimilar (plug f (Repeat r None None t)) (Repeat r None None t).
  Proof.
    intros Hk Hb Hn Hi Nf Hface Hown Hre Herr r Hr Ht.
    apply (@by_relation _ _ (fun a b => exists r, normal r = true /\ a = plug f (Repeat r None None t) /\
      b = Repeat r None None t)); [|exists r; auto].
    clear r Hr. intros a b (r & Hr & -> & ->). set (R := Repeat r None None t).
    destruct (Hface R) as (F1 & F2 & F3 & F4 & F5).
    assert (NR : normal R = true) by (cbn [R normal some_left]; rewrite Hr, Ht; reflexivity).
    assert (F : face (plug f R) R).
    { split; [| rewrite F2; apply alike_refl | | apply Nf; exact Hr | exact NR |
        rewrite F4; apply alike_refl | rewrite F5; reflexivity].
      - eapply alike_trans; [exact F1|]. intros v. rewrite in_app_iff. cbn [R names]. rewrite in_app_iff.
        specialize (Hn v). tauto.
      - eapply alike_trans; [exact F3|]. intros v. rewrite in_app_iff. cbn [R numbers]. rewrite in_app_iff.
        specialize (Hi v). tauto. }
    assert (Ctx : forall K, similar (enter (Round_of None None t) (enter f K)) (enter (Round_of None None t) K)).
    { intros K.
      assert (P1 : is_around (Round_of None None t) (names t) (numbers t)) by (repeat split; apply alike_refl).
      assert (P2 : is_around f (frame_names f) (frame_numbers f)) by (split; [exact Hk | split; apply alike_refl]).
      assert (P3 : is_around (Round_of None None t) (names t ++ frame_names f) (numbers t ++ frame_numbers f)).
      { split; [reflexivity | split; intros y; rewrite in_app_iff; cbn [frame_names frame_numbers];
          [specialize (Hn y) | specialize (Hi y)]; tauto]. }
      eapply enter_two; [exact P1 | exact P2 | exact P3]. }
    split; [exact F | split; intros e K S u Hu].
    - apply goes_plug in Hu; [|exact Hb]. destruct Hu as [Hu | (w & Hw & Hu)]; [destruct (Hown _ _ _ _ _ Hu)|].
      change R with (plug (Round_of None None t) r) in Hw. apply goes_plug in Hw; [|reflexivity].
      destruct Hw as [[] | (v & Hv & Hw)]. assert (Nv := goes_normal Hv Hr). eapply goes_similar in Hv; [|apply Ctx].
      assert (Step : forall u', In u' (lift (Round_of None None t) K v) -> goes e K S R u').
      { intros u' Hu'. change R with (plug (Round_of None None t) r). eapply Within; eassumption. }
      destruct v as [l S1 [x | | m | x] E]; destruct Hw as [<- | []].
      + change (In u [By l S1 (Next (replug f (Repeat x None None t))) E]) in Hu. rewrite Hre in Hu.
        destruct Hu as [<- | []].
        eexists. split; [apply Step; left; reflexivity|]. split; [reflexivity | split;
          [reflexivity|]]. left. exists x. auto.
      + change (In u [By l (clear (keys t) S1) (Next (replug f (Repeat t None None t))) (E ++ begun t)]) in Hu.
        rewrite Hre in Hu.
        destruct Hu as [<- | []].
        eexists. split; [apply Step; left; reflexivity|]. split; [reflexivity | split;
          [reflexivity|]]. left. exists t. auto.
      + rewrite Herr in Hu. destruct Hu as [<- | []]. eexists. split; [apply Step; left; reflexivity|]. cbn. auto.
      + destruct Hu as [<- | []]. eexists. split; [apply Step; left; reflexivity|]. cbn. auto.
    - change R with (plug (Round_of None None t) r) in Hu. apply goes_plug in Hu; [|reflexivity].
      destruct Hu as [[] | (v & Hv & Hu)]. assert (Nv := goes_normal Hv Hr).
      eapply goes_similar in Hv; [|apply similar_sym, Ctx].
      assert (Step : forall v1 u', In v1 (lift (Round_of None None t) (enter f K) v) -> In u' (lift f K v1) ->
        goes e K S (plug f R) u').
      { intros v1 u' Hv1 Hu'. change R with (plug (Round_of None None t) r).
        eapply Within; [eapply Within; [exact Hv | exact Hv1] | exact Hu']. }
      destruct v as [l S1 [x | | m | x] E]; destruct Hu as [<- | []].
      + eexists. split; [eapply Step; [left; reflexivity | cbn [lift]; left; reflexivity]|].
        split; [reflexivity | split; [reflexivity|]]. left. exists x.
        split; [exact Nv | split; [apply Hre | reflexivity]].
      + eexists. split; [eapply Step; [left; reflexivity | cbn [lift]; left; reflexivity]|].
        split; [reflexivity | split; [reflexivity|]]. left. exists t.
        split; [exact Ht | split; [apply Hre | reflexivity]].
      + eexists. split; [eapply Step; [left; reflexivity | rewrite Herr; left; reflexivity]|]. cbn. auto.
      + eexists. split; [eapply Step; [left; reflexivity | left; reflexivity]|]. cbn. auto.
  Qed.

  (** [repeat repeat t = repeat t] *)
  Theorem repeat_repeat r t more : some_left more = true -> normal r = true -> normal t = true ->
    bisimilar (Repeat (Repeat r None None t) more None (Repeat t None None t)) (Repeat r None None t).
  Proof.
    intros Hm Hr Ht. apply (@endless_rounds (Round_of more None (Repeat t None None t)) t); auto.
    - intros v. cbn. rewrite in_app_iff. tauto.
    - intros v. cbn. rewrite in_app_iff. tauto.
    - intros x Hx. cbn [plug normal some_left]. rewrite Hx, Ht, Hm. reflexivity.
    - intros x. repeat split; apply alike_refl.
  Qed.

  (** {1 Fresh keys} *)

  Lemma clear_twice ks ks' S : clear ks (clear ks' S) = clear (ks ++ ks') S.
  Proof.
    unfold clear, with_space, with_code. cbn. f_equal. rewrite forget_twice_law. apply forget_law.
    intros i. rewrite !in_app_iff. tauto.
  Qed.

  (** [fresh { k -> fresh { k' -> t } } = fresh { k, k' -> t }] *)
  Theorem fresh_twice ks ks' r : normal r = true -> bisimilar (Fresh ks (Fresh ks' r)) (Fresh (ks ++ ks') r).
  Proof.
    intros Hr.
    apply (@by_relation _ _ (fun a b => exists r, normal r = true /\ a = Fresh ks (Fresh ks' r) /\
      b = Fresh (ks ++ ks') r)); [|exists r; auto].
    clear r Hr. intros a b (r & Hr & -> & ->).
    assert (F : face (Fresh ks (Fresh ks' r)) (Fresh (ks ++ ks') r)).
    { split; try exact Hr; cbn [names numbers keys]; try (rewrite app_assoc); try apply alike_refl. reflexivity. }
    assert (Ctx : forall K, similar (enter (With_keys ks') (enter (With_keys ks) K)) (enter (With_keys (ks ++ ks')) K)).
    { intros K.
      assert (P : forall is, is_around (With_keys is) [] is) by (intros is; repeat split; apply alike_refl).
      assert (P3 : is_around (With_keys (ks ++ ks')) ([] ++ []) (ks' ++ ks)).
      { repeat split; try apply alike_refl; cbn [frame_numbers]; rewrite !in_app_iff; tauto. }
      eapply enter_two; [apply P | apply P | exact P3]. }
    split; [exact F | split; intros e K S u Hu].
    - change (Fresh ks (Fresh ks' r)) with (plug (With_keys ks) (plug (With_keys ks') r)) in Hu.
      apply goes_plug in Hu; [|reflexivity]. destruct Hu as [[] | (w & Hw & Hu)].
      apply goes_plug in Hw; [|reflexivity]. destruct Hw as [[] | (v & Hv & Hw)].
      assert (Nv := goes_normal Hv Hr). eapply goes_similar in Hv; [|apply Ctx].
      assert (Step : forall u', In u' (lift (With_keys (ks ++ ks')) K v) -> goes e K S (Fresh (ks ++ ks') r) u').
      { intros u' Hu'. change (Fresh (ks ++ ks') r) with (plug (With_keys (ks ++ ks')) r). eapply Within; eassumption. }
      destruct v as [l S1 [x | | m | x] E]; destruct Hw as [<- | []]; destruct Hu as [<- | []];
        (eexists; split; [apply Step; left; reflexivity|]);
        (split; [reflexivity | split; [rewrite ?clear_twice; reflexivity|]]); auto.
      left. exists x. auto.
    - change (Fresh (ks ++ ks') r) with (plug (With_keys (ks ++ ks')) r) in Hu.
      apply goes_plug in Hu; [|reflexivity]. destruct Hu as [[] | (v & Hv & Hu)].
      assert (Nv := goes_normal Hv Hr). eapply goes_similar in Hv; [|apply similar_sym, Ctx].
      assert (Step : forall w u', In w (lift (With_keys ks') (enter (With_keys ks) K) v) ->
        In u' (lift (With_keys ks) K w) -> goes e K S (Fresh ks (Fresh ks' r)) u').
      { intros w u' Hw Hu'. change (Fresh ks (Fresh ks' r)) with (plug (With_keys ks) (plug (With_keys ks') r)).
        eapply Within; [eapply Within; [exact Hv | exact Hw] | exact Hu']. }
      destruct v as [l S1 [x | | m | x] E]; destruct Hu as [<- | []];
        (eexists; split; [eapply Step; [left; reflexivity | left; reflexivity]|]);
        (split; [reflexivity | split; [rewrite ?clear_twice; reflexivity|]]); auto.
      left. exists x. auto.
  Qed.

  (** {1 Ends} *)

  (** [(t ensure { D }) ensure { D' } = t ensure { D; D' }] *)
  Theorem ensure_twice ds es r : normal (Ensure (Ensure r ds) es) = true ->
    bisimilar (Ensure (Ensure r ds) es) (Ensure r (ds ++ es)).
  Proof.
    intros Hn.
    apply (@by_relation _ _ (fun a b => exists r, normal (Ensure (Ensure r ds) es) = true /\
      a = Ensure (Ensure r ds) es /\ b = Ensure r (ds ++ es))); [|exists r; auto].
    clear r Hn. intros a b (r & Hn & -> & ->).
    assert (Hr : normal r = true) by (cbn [normal] in Hn; rewrite !andb_true_iff in Hn; tauto).
    assert (F : face (Ensure (Ensure r ds) es) (Ensure r (ds ++ es))).
    { split; try apply alike_refl; try exact Hn.
      - cbn [normal] in *. rewrite forallb_app, app_length, !andb_true_iff in *. destruct es; cbn in *; intuition.
        destruct ds; reflexivity.
      - intros S. cbn [ensured]. rewrite app_assoc. reflexivity. }
    assert (P : forall xs, is_around (Ensuring xs) [] []) by (intros xs; repeat split; apply alike_refl).
    assert (Ctx : forall K, similar (enter (Ensuring ds) (enter (Ensuring es) K)) (enter (Ensuring (ds ++ es)) K)).
    { intros K. eapply enter_two; [apply P | apply P | apply P]. }
    split; [exact F | split; intros e K S u Hu].
    - change (Ensure (Ensure r ds) es) with (plug (Ensuring es) (plug (Ensuring ds) r)) in Hu.
      apply goes_plug in Hu; [|reflexivity]. destruct Hu as [[] | (w & Hw & Hu)].
      apply goes_plug in Hw; [|reflexivity]. destruct Hw as [[] | (v & Hv & Hw)].
      assert (Nv := goes_normal Hv Hr). eapply goes_similar in Hv; [|apply Ctx].
      assert (Step : forall u', In u' (lift (Ensuring (ds ++ es)) K v) -> goes e K S (Ensure r (ds ++ es)) u').
      { intros u' Hu'. change (Ensure r (ds ++ es)) with (plug (Ensuring (ds ++ es)) r). eapply Within; eassumption. }
      destruct v as [l S1 [x | | m | x] E]; destruct Hw as [<- | []]; destruct Hu as [<- | []];
        (eexists; split; [apply Step; left; reflexivity|]);
        (split; [reflexivity | split; [rewrite ?does_app; reflexivity|]]); auto.
      left. exists x. split; [|auto]. cbn [normal next_normal] in *. rewrite Nv. rewrite !andb_true_iff in *. tauto.
    - change (Ensure r (ds ++ es)) with (plug (Ensuring (ds ++ es)) r) in Hu.
      apply goes_plug in Hu; [|reflexivity]. destruct Hu as [[] | (v & Hv & Hu)].
      assert (Nv := goes_normal Hv Hr). eapply goes_similar in Hv; [|apply similar_sym, Ctx].
      assert (Step : forall w u', In w (lift (Ensuring ds) (enter (Ensuring es) K) v) ->
        In u' (lift (Ensuring es) K w) -> goes e K S (Ensure (Ensure r ds) es) u').
      { intros w u' Hw Hu'. change (Ensure (Ensure r ds) es) with (plug (Ensuring es) (plug (Ensuring ds) r)).
        eapply Within; [eapply Within; [exact Hv | exact Hw] | exact Hu']. }
      destruct v as [l S1 [x | | m | x] E]; destruct Hu as [<- | []];
        (eexists; split; [eapply Step; [left; reflexivity | left; reflexivity]|]);
        (split; [reflexivity | split; [rewrite ?does_app; reflexivity|]]); auto.
      left. exists x. split; [|auto]. cbn [normal next_normal] in *. rewrite Nv. rewrite !andb_true_iff in *. tauto.
  Qed.

  (** [(until { g } run t) ensure { D } = until { g } run (t ensure { D })], and so [assure], [during n], [within]. *)
  Definition cuts (f : frame) : bool := match f with Body_until _ _ | Body_during _ _ _ => true | _ => false end.

  Theorem ensure_inside f ds r : cuts f = true -> normal (Ensure r ds) = true ->
    bisimilar (Ensure (plug f r) ds) (plug f (Ensure r ds)).
  Proof.
    intros Hf Hn.
    apply (@by_relation _ _ (fun a b => exists r, normal (Ensure r ds) = true /\
      a = Ensure (plug f r) ds /\ b = plug f (Ensure r ds))); [|exists r; auto].
    clear r Hn. intros a b (r & Hn & -> & ->).
    assert (Hr : normal r = true) by (cbn [normal] in Hn; rewrite !andb_true_iff in Hn; tauto).
    assert (F : face (Ensure (plug f r) ds) (plug f (Ensure r ds))).
    { destruct f; try discriminate Hf; split; try apply alike_refl; try exact Hn; reflexivity. }
    assert (Hb : is_beside f = false) by (destruct f; try discriminate Hf; reflexivity).
    assert (P : is_around (Ensuring ds) [] []) by (repeat split; apply alike_refl).
    assert (Pf : is_around f [] (frame_numbers f))
      by (destruct f; try discriminate Hf; repeat split; apply alike_refl).
    assert (Ctx : forall K, similar (enter f (enter (Ensuring ds) K)) (enter (Ensuring ds) (enter f K)))
      by (intros K; eapply enter_swap; eassumption).
    assert (Left : forall e K S u u1, In u (own e K S (plug f r)) -> In u1 (lift (Ensuring ds) K u) ->
      exists u2, In u2 (own e K S (plug f (Ensure r ds))) /\ agree eq u1 u2).
    { intros e K S u u1. destruct f; try discriminate Hf; cbn [plug own ensured].
      - unfold guarded, coded, breaks. destruct e; [intros []|].
        destruct (runs g [] K S) as [x s N0 x0 | m x0 | m x0 | m s N0 x0 |]; try (intros []; fail);
          [destruct (truth x) as [[]|], k | destruct (is_unknown m) | |]; try (intros []; fail);
          intros [<- | []] [<- | []]; (eexists; split; [left; reflexivity|]); cbn; rewrite ?does_app; auto.
      - destruct e as [[]|]; try (intros []; fail). destruct (timer_eq i0 i); [|intros []].
        intros [<- | []]. destruct k; intros [<- | []]; (eexists; split; [left; reflexivity|]); cbn;
          rewrite ?does_app; auto. }
    assert (Right : forall e K S u2, In u2 (own e K S (plug f (Ensure r ds))) ->
      exists u u1, In u (own e K S (plug f r)) /\ In u1 (lift (Ensuring ds) K u) /\ agree eq u2 u1).
    { intros e K S u2. destruct f; try discriminate Hf; cbn [plug own ensured].
      - unfold guarded, coded, breaks. destruct e; [intros []|].
        destruct (runs g [] K S) as [x s N0 x0 | m x0 | m x0 | m s N0 x0 |]; try (intros []; fail);
          [destruct (truth x) as [[]|], k | destruct (is_unknown m) | |]; try (intros []; fail);
          intros [<- | []]; (do 2 eexists; split; [left; reflexivity | split; [left; reflexivity|]]); cbn;
          rewrite ?does_app; auto.
      - destruct e as [[]|]; try (intros []; fail). destruct (timer_eq i0 i); [|intros []].
        intros [<- | []]. destruct k; (do 2 eexists; split; [left; reflexivity | split; [left; reflexivity|]]); cbn;
          rewrite ?does_app; auto. }
    assert (Inside : forall K v w u, In w (lift f (enter (Ensuring ds) K) v) -> In u (lift (Ensuring ds) K w) ->
      next_normal v -> exists w' u', In w' (lift (Ensuring ds) (enter f K) v) /\ In u' (lift f K w') /\
        agree (fun a b => exists r, normal (Ensure r ds) = true /\ a = Ensure (plug f r) ds /\
          b = plug f (Ensure r ds)) u u').
    { intros K [l S1 [x | | m | x] E] w u Hw Hu Nv; destruct f; try discriminate Hf; destruct Hw as [<- | []];
        destruct Hu as [<- | []]; (do 2 eexists; split; [left; reflexivity | split; [left; reflexivity|]]);
        (split; [reflexivity | split; [reflexivity|]]); auto;
        (exists x; split; [|auto]; cbn [normal next_normal] in *; rewrite Nv; rewrite !andb_true_iff in *; tauto). }
    assert (Outside : forall K v w u, In w (lift (Ensuring ds) (enter f K) v) -> In u (lift f K w) ->
      next_normal v -> exists w' u', In w' (lift f (enter (Ensuring ds) K) v) /\ In u' (lift (Ensuring ds) K w') /\
        agree (fun b a => exists r, normal (Ensure r ds) = true /\ a = Ensure (plug f r) ds /\
          b = plug f (Ensure r ds)) u u').
    { intros K [l S1 [x | | m | x] E] w u Hw Hu Nv; destruct f; try discriminate Hf; destruct Hw as [<- | []];
        destruct Hu as [<- | []]; (do 2 eexists; split; [left; reflexivity | split; [left; reflexivity|]]);
        (split; [reflexivity | split; [reflexivity|]]); auto;
        (exists x; split; [|auto]; cbn [normal next_normal] in *; rewrite Nv; rewrite !andb_true_iff in *; tauto). }
    split; [exact F | split; intros e K S u Hu].
    - assert (Nu := goes_normal Hu (face_normal F)).
      change (Ensure (plug f r) ds) with (plug (Ensuring ds) (plug f r)) in Hu.
      apply goes_plug in Hu; [|reflexivity]. destruct Hu as [[] | (w & Hw & Hu)].
      apply goes_plug in Hw; [|exact Hb]. destruct Hw as [Hw | (v & Hv & Hw)].
      + rewrite (own_similar e S (plug f r) (enter_none K P)) in Hw. destruct (Left _ _ _ _ _ Hw Hu) as (u2 & H2 & A).
        exists u2. split; [apply Itself; exact H2|]. eapply agree_more'; [exact A | exact Nu | apply up_refl].
      + assert (Nv := goes_normal Hv Hr). destruct (Inside _ _ _ _ Hw Hu Nv) as (w' & u' & Hw' & Hu' & A).
        exists u'. split; [|eapply agree_more; [|exact A]; intros x y H; left; exact H].
        eapply Within; [|exact Hu']. change (Ensure r ds) with (plug (Ensuring ds) r).
        eapply Within; [|exact Hw']. eapply goes_similar; [exact Hv | apply Ctx].
    - assert (Nu := goes_normal Hu (face_normal' F)). apply goes_plug in Hu; [|exact Hb].
      destruct Hu as [Hu | (w & Hw & Hu)].
      + destruct (Right _ _ _ _ Hu) as (v & u1 & Hv & Hu1 & A). exists u1. split.
        * change (Ensure (plug f r) ds) with (plug (Ensuring ds) (plug f r)). eapply Within; [|exact Hu1].
          apply Itself. rewrite (own_similar e S (plug f r) (enter_none K P)). exact Hv.
        * eapply agree_more'; [exact A | exact Nu | apply up_refl].
      + change (Ensure r ds) with (plug (Ensuring ds) r) in Hw. apply goes_plug in Hw; [|reflexivity].
        destruct Hw as [[] | (v & Hv & Hw)]. assert (Nv := goes_normal Hv Hr).
        destruct (Outside _ _ _ _ Hw Hu Nv) as (w' & u' & Hw' & Hu' & A).
        exists u'. split; [|eapply agree_more; [|exact A]; intros x y H; left; exact H].
        change (Ensure (plug f r) ds) with (plug (Ensuring ds) (plug f r)).
        eapply Within; [|exact Hu']. eapply Within; [|exact Hw'].
        eapply goes_similar; [exact Hv | apply similar_sym, Ctx].
  Qed.
End Laws.
