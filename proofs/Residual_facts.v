(** Facts about residuals: what their normal forms name, run and have recruited, and when they are well formed. *)
From Dolphin Require Export Script.

Section Facts.
  Context {L : Names} {C : Code}.

  (** {1 Induction on tasks} *)

  Section Induction.
    Variable P : task -> Prop.
    Hypothesis on_plan : forall p, P (TPlan p).
    Hypothesis on_action : forall a, P (TAction a).
    Hypothesis on_condition : forall g, P (TCondition g).
    Hypothesis on_sequence : forall t t', P t -> P t' -> P (TSequence t t').
    Hypothesis on_parallel : forall t t', P t -> P t' -> P (TParallel t t').
    Hypothesis on_allocated : forall t vs, P t -> P (TAllocated t vs).
    Hypothesis on_all_of : forall bs, Forall (fun b => P (snd b)) bs -> P (TAll_of bs).
    Hypothesis on_one_of : forall bs, Forall (fun b => P (snd b)) bs -> P (TOne_of bs).
    Hypothesis on_until : forall k g t, P t -> P (TUntil k g t).
    Hypothesis on_idle : forall n, P (TIdle n).
    Hypothesis on_confirm : forall x s, P (TConfirm x s).
    Hypothesis on_during : forall k d t, P t -> P (TDuring k d t).
    Hypothesis on_watch : forall t h, P t -> P (TWatch t h).
    Hypothesis on_repeat : forall n g t, P t -> P (TRepeat n g t).
    Hypothesis on_made : forall a, P (TMade a).
    Hypothesis on_recruit : forall q a, P (TRecruit q a).
    Hypothesis on_fresh : forall a, P (TFresh a).
    Hypothesis on_keys : forall ks a t, P t -> P (TKeys ks a t).
    Hypothesis on_ensure : forall t ds, P t -> P (TEnsure t ds).

    Fixpoint task_rect' (t : task) : P t :=
      let fix branches (bs : list (code * task)) : Forall (fun b => P (snd b)) bs :=
        match bs with
        | [] => Forall_nil _
        | (g, t) as b :: bs => Forall_cons (P := fun b => P (snd b)) (g, t) (task_rect' t) (branches bs)
        end in
      match t with
      | TPlan p => on_plan p
      | TAction a => on_action a
      | TCondition g => on_condition g
      | TSequence t t' => on_sequence t t' (task_rect' t) (task_rect' t')
      | TParallel t t' => on_parallel t t' (task_rect' t) (task_rect' t')
      | TAllocated t vs => on_allocated t vs (task_rect' t)
      | TAll_of bs => on_all_of bs (branches bs)
      | TOne_of bs => on_one_of bs (branches bs)
      | TUntil k g t => on_until k g t (task_rect' t)
      | TIdle n => on_idle n
      | TConfirm x s => on_confirm x s
      | TDuring k d t => on_during k d t (task_rect' t)
      | TWatch t h => on_watch t h (task_rect' t)
      | TRepeat n g t => on_repeat n g t (task_rect' t)
      | TMade a => on_made a
      | TRecruit q a => on_recruit q a
      | TFresh a => on_fresh a
      | TKeys ks a t => on_keys ks a t (task_rect' t)
      | TEnsure t ds => on_ensure t ds (task_rect' t)
      end.
  End Induction.

  (** {1 What a vehicle runs} *)

  Fixpoint lookup (v : vehicle) (l : list (vehicle * plan)) : option plan :=
    match l with [] => None | (w, p) :: l => if vehicle_eq v w then Some p else lookup v l end.

  (** What [v] runs in [r]. *)
  Definition run_at (r : residual) (v : vehicle) : option plan := lookup v (running r).

  Lemma lookup_app v a b :
    lookup v (a ++ b) = match lookup v a with Some p => Some p | None => lookup v b end.
  Proof. induction a as [|(w, p) a IH]; cbn; [reflexivity|]. destruct (vehicle_eq v w); auto. Qed.

  Lemma lookup_none v l : lookup v l = None <-> ~ In v (map fst l).
  Proof.
    induction l as [|(w, p) l IH]; cbn; [tauto|]. destruct (vehicle_eq v w) as [->|].
    - split; [discriminate | intros H; exfalso; auto].
    - rewrite IH. split; intros H; [intros [H' | H']; [congruence | auto] | auto].
  Qed.

  Lemma lookup_in v l p : lookup v l = Some p -> In (v, p) l.
  Proof.
    induction l as [|(w, q) l IH]; cbn; [discriminate|]. destruct (vehicle_eq v w) as [->|]; intros H.
    - injection H as ->. auto.
    - auto.
  Qed.

  (** {1 Parts to come} *)

  (** Nothing of [r] runs, was recruited or holds vehicles, nor any of its parts: it is as it was built. *)
  Fixpoint quiet (r : residual) : bool :=
    match r with
    | Running _ _ | Recruited _ _ | Holding _ _ => false
    | Sequence r t | Repeat r _ _ t => quiet r && quiet t
    | Parallel rs => forallb quiet rs
    | Branch r bs => quiet r && forallb (fun b => quiet (snd b)) bs
    | All_of bs | One_of bs => forallb (fun b => quiet (snd b)) bs
    | Until _ _ r | During _ _ _ r | During_code _ _ _ r | Watch r _ | Asked _ _ r | Fresh _ r | Ensure r _ => quiet r
    | Ready _ _ | Action _ | Condition _ | Idle _ _ | Confirm _ _ _ | Made _ _ _ | Unallocated _ _
    | Recruit _ _ _ _ _ => true
    end.

  Lemma flat_map_nil (X Y : Type) (f : X -> list Y) xs : (forall x, In x xs -> f x = []) -> flat_map f xs = [].
  Proof.
    induction xs as [|x xs IH]; intros H; [reflexivity|]. cbn. rewrite H by (left; reflexivity).
    apply IH. intros. apply H. right. assumption.
  Qed.

  Lemma quiet_still r : quiet r = true -> running r = [] /\ recruits r = [].
  Proof.
    induction r using residual_rect'; cbn; intros Q; try discriminate; auto;
      try (apply andb_true_iff in Q; destruct Q as [Q Q']; auto; fail).
    rewrite forallb_forall in Q. rewrite Forall_forall in H.
    split; apply flat_map_nil; intros r Hr; apply H; auto.
  Qed.

  Lemma quiet_running r : quiet r = true -> running r = [].
  Proof. intros H. apply quiet_still in H. tauto. Qed.

  Lemma quiet_recruits r : quiet r = true -> recruits r = [].
  Proof. intros H. apply quiet_still in H. tauto. Qed.

  (** {1 What runs or was recruited is named} *)

  Lemma running_named r v : In v (run_of r) -> In v (names r).
  Proof.
    unfold run_of. revert v.
    induction r using residual_rect'; cbn; intros v0 Hv; try contradiction; rewrite ?in_app_iff; auto.
    rewrite in_map_iff in Hv. destruct Hv as ((w & p) & <- & Hv).
    apply in_flat_map in Hv. destruct Hv as (r & Hr & Hv).
    rewrite Forall_forall in H. apply in_flat_map. exists r. split; [exact Hr|].
    apply H; [exact Hr|]. apply in_map_iff. exists (w, p). auto.
  Qed.

  Lemma recruits_named r v : In v (recruits r) -> In v (names r).
  Proof.
    revert v. induction r using residual_rect'; cbn; intros v0 Hv; try contradiction; rewrite ?in_app_iff; auto.
    - apply in_flat_map in Hv. destruct Hv as (r & Hr & Hv).
      rewrite Forall_forall in H. apply in_flat_map. exists r. auto.
    - destruct Hv as [Hv | Hv]; auto.
  Qed.

  Lemma run_at_not_named r v : ~ In v (names r) -> run_at r v = None.
  Proof. intros H. apply lookup_none. intros Hv. apply H. apply running_named. exact Hv. Qed.

  (** {1 Normal forms} *)

  Lemma names_sequence r t v : In v (names (sequence r t)) <-> In v (names r) \/ In v (names t).
  Proof.
    revert v. induction r using residual_rect'; intros v0; cbn [sequence names]; rewrite ?in_app_iff; try tauto.
    rewrite IHr2. tauto.
  Qed.

  Lemma running_sequence r t : running (sequence r t) = running r.
  Proof. destruct r; reflexivity. Qed.

  Lemma recruits_sequence r t : recruits (sequence r t) = recruits r.
  Proof. destruct r; reflexivity. Qed.

  Lemma waits_sequence r t : waits (sequence r t) = waits r.
  Proof. destruct r; reflexivity. Qed.

  Lemma quiet_sequence r t : quiet (sequence r t) = quiet r && quiet t.
  Proof.
    induction r; cbn [sequence quiet]; rewrite ?andb_assoc; try reflexivity.
    rewrite IHr2. rewrite andb_assoc. reflexivity.
  Qed.

  (** A function of residuals that goes through [|] sees a flat one as its parts. *)
  Definition through {X : Type} (f : residual -> list X) : Prop := forall rs, f (Parallel rs) = flat_map f rs.

  Lemma through_flat X (f : residual -> list X) r : through f -> flat_map f (flat r) = f r.
  Proof. intros H. destruct r; cbn [flat flat_map]; rewrite ?app_nil_r; auto. Qed.

  Lemma through_flats X (f : residual -> list X) rs : through f -> flat_map f (flat_map flat rs) = flat_map f rs.
  Proof.
    intros H. induction rs as [|r rs IH]; [reflexivity|]. cbn [flat_map].
    rewrite flat_map_app, through_flat, IH by exact H. reflexivity.
  Qed.

  Lemma through_parallel X (f : residual -> list X) rs : through f -> f (parallel rs) = flat_map f rs.
  Proof.
    intros H. unfold parallel. rewrite <- (through_flats _ _ rs H).
    destruct (flat_map flat rs) as [|r [|r' rest]]; [apply H | | apply H].
    cbn. rewrite app_nil_r. reflexivity.
  Qed.

  Lemma through_splice X (f : residual -> list X) before r after :
    through f -> f (Parallel (before ++ flat r ++ after)) = flat_map f before ++ f r ++ flat_map f after.
  Proof. intros H. rewrite H, !flat_map_app, through_flat by exact H. reflexivity. Qed.

  Lemma through_names : through names. Proof. intros rs. reflexivity. Qed.
  Lemma through_running : through running. Proof. intros rs. reflexivity. Qed.
  Lemma through_recruits : through recruits. Proof. intros rs. reflexivity. Qed.
  Lemma through_keys : through keys. Proof. intros rs. reflexivity. Qed.
  Lemma through_ensured : through ensured. Proof. intros rs. reflexivity. Qed.
  Lemma through_waits : through waits. Proof. intros rs. reflexivity. Qed.

  Lemma names_repeat r more g t v :
    In v (names (repeat_ r more g t)) -> In v (names r) \/ In v (names t).
  Proof. unfold repeat_. destruct more as [[|n]|]; cbn; rewrite ?in_app_iff; auto. Qed.

  Lemma running_repeat r more g t : running (repeat_ r more g t) = running r.
  Proof. unfold repeat_. destruct more as [[|n]|]; reflexivity. Qed.

  Lemma recruits_repeat r more g t : recruits (repeat_ r more g t) = recruits r.
  Proof. unfold repeat_. destruct more as [[|n]|]; reflexivity. Qed.

  Lemma waits_repeat r more g t : waits (repeat_ r more g t) = waits r.
  Proof. unfold repeat_. destruct more as [[|n]|]; reflexivity. Qed.

  Lemma keys_sequence r t : keys (sequence r t) = keys r.
  Proof. induction r; cbn [sequence keys]; auto. Qed.

  Lemma keys_repeat r more g t : keys (repeat_ r more g t) = keys r.
  Proof. unfold repeat_. destruct more as [[|n]|]; reflexivity. Qed.

  Lemma keys_branch_of r bs : keys (branch_of r bs) = keys r.
  Proof. destruct bs; reflexivity. Qed.

  Lemma keys_all_of bs : keys (all_of bs) = [].
  Proof. destruct bs as [|b [|b' bs]]; reflexivity. Qed.

  Lemma ensured_sequence r t : ensured (sequence r t) = ensured r.
  Proof. induction r; cbn [sequence ensured]; auto. Qed.

  Lemma ensured_repeat r more g t : ensured (repeat_ r more g t) = ensured r.
  Proof. unfold repeat_. destruct more as [[|n]|]; reflexivity. Qed.

  Lemma ensured_branch_of r bs : ensured (branch_of r bs) = ensured r.
  Proof. destruct bs; reflexivity. Qed.

  Lemma ensured_all_of bs : ensured (all_of bs) = [].
  Proof. destruct bs as [|b [|b' bs]]; reflexivity. Qed.

  Lemma names_branch_of r bs v :
    In v (names (branch_of r bs)) <-> In v (names r) \/ In v (flat_map (fun b => names (snd b)) bs).
  Proof. destruct bs; cbn; rewrite ?in_app_iff; tauto. Qed.

  Lemma running_branch_of r bs : running (branch_of r bs) = running r.
  Proof. destruct bs; reflexivity. Qed.

  Lemma recruits_branch_of r bs : recruits (branch_of r bs) = recruits r.
  Proof. destruct bs; reflexivity. Qed.

  Lemma waits_branch_of r bs : waits (branch_of r bs) = waits r.
  Proof. destruct bs; reflexivity. Qed.

  Lemma names_all_of bs : names (all_of bs) = flat_map (fun b => names (snd b)) bs.
  Proof. destruct bs as [|b [|b' bs]]; reflexivity. Qed.

  Lemma running_all_of bs : running (all_of bs) = [].
  Proof. destruct bs as [|b [|b' bs]]; reflexivity. Qed.

  Lemma recruits_all_of bs : recruits (all_of bs) = [].
  Proof. destruct bs as [|b [|b' bs]]; reflexivity. Qed.

  Lemma waits_all_of bs : waits (all_of bs) = [].
  Proof. destruct bs as [|b [|b' bs]]; reflexivity. Qed.

  Lemma given_same ds r :
    names (given ds r) = names r /\ running (given ds r) = running r /\ recruits (given ds r) = recruits r /\
    waits (given ds r) = waits r /\ quiet (given ds r) = quiet r.
  Proof.
    induction r; cbn [given]; try (repeat split; reflexivity).
    - destruct (has_parameters a); repeat split; reflexivity.
    - destruct IHr as (H1 & H2 & H3 & H4 & H5). unfold ensure_. destruct (given_back ds ds0); cbn; auto.
  Qed.

  Lemma keys_given ds r : keys (given ds r) = keys r.
  Proof.
    induction r; cbn [given]; try reflexivity.
    - destruct (has_parameters a); reflexivity.
    - unfold ensure_. destruct (given_back ds ds0); cbn; auto.
  Qed.

  Lemma ensure_same r ds :
    names (ensure_ r ds) = names r /\ running (ensure_ r ds) = running r /\ recruits (ensure_ r ds) = recruits r /\
    waits (ensure_ r ds) = waits r /\ quiet (ensure_ r ds) = quiet r /\ numbers (ensure_ r ds) = numbers r.
  Proof. destruct ds; cbn; auto 10. Qed.

  (** {1 Well-formed residuals} *)

  (** No vehicle is named on both sides of a [|]. *)
  Fixpoint apart (rs : list residual) : Prop :=
    match rs with
    | [] => True
    | r :: rs => (forall v, In v (names r) -> ~ In v (flat_map names rs)) /\ apart rs
    end.

  Lemma apart_app a b :
    apart (a ++ b) <-> apart a /\ apart b /\ forall v, In v (flat_map names a) -> ~ In v (flat_map names b).
  Proof.
    induction a as [|r a IH]; cbn [app apart flat_map].
    - split; [intros H; repeat split; auto | tauto].
    - rewrite IH, flat_map_app. setoid_rewrite in_app_iff. split.
      + intros (H & Ha & Hb & Hab). split; [split; [|exact Ha]|split; [exact Hb|]]; firstorder.
      + intros ((H & Ha) & Hb & Hab). split; [|split; [exact Ha|split; [exact Hb|]]]; firstorder.
  Qed.

  (** [Wf X r]: what runs or will run in [r] does so on vehicles of [X], or on those that [r] recruited for it; no
      vehicle is named on both sides of a [|], or recruited twice; and parts to come are as they were built. *)
  Inductive Wf : (vehicle -> Prop) -> residual -> Prop :=
  | W_ready : forall (X : vehicle -> Prop) p v, X v -> Wf X (Ready p v)
  | W_running : forall (X : vehicle -> Prop) p v, X v -> Wf X (Running p v)
  | W_action : forall (X : vehicle -> Prop) a, Wf X (Action a)
  | W_condition : forall (X : vehicle -> Prop) g, Wf X (Condition g)
  | W_sequence : forall (X : vehicle -> Prop) r t, Wf X r -> Wf X t -> quiet t = true -> Wf X (Sequence r t)
  | W_parallel : forall (X : vehicle -> Prop) rs, (forall r, In r rs -> Wf X r) -> apart rs -> Wf X (Parallel rs)
  | W_branch : forall (X : vehicle -> Prop) r bs,
      Wf X r -> (forall b, In b bs -> Wf X (snd b)) -> forallb (fun b => quiet (snd b)) bs = true ->
      Wf X (Branch r bs)
  | W_all_of : forall (X : vehicle -> Prop) bs,
      (forall b, In b bs -> Wf X (snd b)) -> forallb (fun b => quiet (snd b)) bs = true -> Wf X (All_of bs)
  | W_one_of : forall (X : vehicle -> Prop) bs,
      (forall b, In b bs -> Wf X (snd b)) -> forallb (fun b => quiet (snd b)) bs = true -> Wf X (One_of bs)
  | W_until : forall (X : vehicle -> Prop) k g r, Wf X r -> Wf X (Until k g r)
  | W_idle : forall (X : vehicle -> Prop) i n, Wf X (Idle i n)
  | W_confirm : forall (X : vehicle -> Prop) i x s, Wf X (Confirm i x s)
  | W_during : forall (X : vehicle -> Prop) k i n r, Wf X r -> Wf X (During k i n r)
  | W_during_code : forall (X : vehicle -> Prop) k i d r, Wf X r -> quiet r = true -> Wf X (During_code k i d r)
  | W_watch : forall (X : vehicle -> Prop) r h, Wf X r -> Wf X (Watch r h)
  | W_repeat : forall (X : vehicle -> Prop) r more g t, Wf X r -> Wf X t -> quiet t = true -> Wf X (Repeat r more g t)
  | W_asked : forall (X : vehicle -> Prop) more g t, Wf X t -> quiet t = true -> Wf X (Asked more g t)
  | W_made : forall (X : vehicle -> Prop) a ys q, Wf X (Made a ys q)
  | W_unallocated : forall (X : vehicle -> Prop) t q, Wf X (Unallocated t q)
  | W_holding : forall (X : vehicle -> Prop) vs r, Wf X r -> Wf X (Holding vs r)
  | W_recruit : forall (X : vehicle -> Prop) i q a j d, Wf X (Recruit i q a j d)
  | W_recruited : forall (X : vehicle -> Prop) v r,
      ~ In v (recruits r) -> Wf (fun u => X u \/ u = v) r -> Wf X (Recruited v r)
  | W_fresh : forall (X : vehicle -> Prop) ks r, Wf X r -> Wf X (Fresh ks r)
  | W_ensure : forall (X : vehicle -> Prop) r ds, Wf X r -> Wf X (Ensure r ds).

  Lemma Wf_more X r : Wf X r -> forall Y : vehicle -> Prop, (forall v, In v (names r) -> X v -> Y v) -> Wf Y r.
  Proof.
    induction 1; intros Y HY; cbn [names] in HY; constructor; auto;
      try (apply HY; cbn; auto; fail);
      try (apply IHWf; intros; apply HY; rewrite ?in_app_iff; auto; fail);
      try (apply IHWf1; intros; apply HY; rewrite ?in_app_iff; auto; fail);
      try (apply IHWf2; intros; apply HY; rewrite ?in_app_iff; auto; fail).
    - intros r Hr. apply H0; [exact Hr|]. intros v Hv. apply HY. apply in_flat_map. eauto.
    - intros b Hb. apply H1; [exact Hb|]. intros v Hv. apply HY. rewrite in_app_iff, in_flat_map. eauto.
    - intros b Hb. apply H0; [exact Hb|]. intros v Hv. apply HY. apply in_flat_map. eauto.
    - intros b Hb. apply H0; [exact Hb|]. intros v Hv. apply HY. apply in_flat_map. eauto.
    - apply IHWf. intros u Hu [Hx | ->]; [left; apply HY; cbn; auto | auto].
  Qed.

  Lemma Wf_sequence X r t : Wf X r -> Wf X t -> quiet t = true -> Wf X (sequence r t).
  Proof.
    intros Hr. revert t. induction Hr; intros t0 Ht Q; cbn [sequence]; try (constructor; auto; constructor; auto; fail).
    constructor; auto. rewrite quiet_sequence, H, Q. reflexivity.
  Qed.

  Lemma Wf_flat X r : Wf X r -> (forall q, In q (flat r) -> Wf X q) /\ apart (flat r).
  Proof.
    intros H. destruct H; cbn [flat];
      try (split; [intros q' [<- | []]; constructor; auto | cbn; auto]; fail).
    auto.
  Qed.

  Lemma Wf_repeat X r more g t : Wf X r -> Wf X t -> quiet t = true -> Wf X (repeat_ r more g t).
  Proof. intros. unfold repeat_. destruct more as [[|n]|]; auto; constructor; auto. Qed.

  Lemma Wf_all_of X bs :
    (forall b, In b bs -> Wf X (snd b)) -> forallb (fun b => quiet (snd b)) bs = true -> Wf X (all_of bs).
  Proof. intros. destruct bs as [|b [|b' bs]]; constructor; auto. Qed.

  Lemma Wf_branch_of X r bs :
    Wf X r -> (forall b, In b bs -> Wf X (snd b)) -> forallb (fun b => quiet (snd b)) bs = true -> Wf X (branch_of r bs).
  Proof. intros. destruct bs; auto. constructor; auto. Qed.

  Lemma Wf_splice X before r after :
    (forall q, In q (before ++ after) -> Wf X q) -> apart (before ++ after) -> Wf X r ->
    (forall v, In v (names r) -> ~ In v (flat_map names (before ++ after))) ->
    Wf X (Parallel (before ++ flat r ++ after)).
  Proof.
    intros Ho Ha Hr Hd. destruct (Wf_flat _ _ Hr) as [Hf Hfa]. constructor.
    - intros q. rewrite !in_app_iff. intros [Hq | [Hq | Hq]]; auto; apply Ho; apply in_app_iff; auto.
    - rewrite flat_map_app in Hd. setoid_rewrite in_app_iff in Hd.
      apply apart_app in Ha. destruct Ha as (Hb & Hc & Hbc).
      apply apart_app. split; [exact Hb|]. split.
      + apply apart_app. split; [exact Hfa|]. split; [exact Hc|].
        intros v. rewrite through_flat by apply through_names. intros Hv Hv'. apply (Hd v Hv). auto.
      + intros v Hv. rewrite flat_map_app, through_flat by apply through_names. rewrite in_app_iff.
        intros [Hv' | Hv']; [apply (Hd v Hv'); auto | apply (Hbc v Hv Hv')].
  Qed.

  Lemma Wf_parallel X rs : (forall q, In q rs -> Wf X q) -> apart rs -> Wf X (parallel rs).
  Proof.
    intros Hw Ha. unfold parallel.
    assert (H : (forall q, In q (flat_map flat rs) -> Wf X q) /\ apart (flat_map flat rs)).
    { induction rs as [|r rs IH]; cbn [flat_map]; [split; [intros q [] | exact I]|].
      destruct Ha as [Ha Hb]. destruct IH as [IH1 IH2]; [intros; apply Hw; right; auto | exact Hb |].
      destruct (Wf_flat _ _ (Hw r (or_introl eq_refl))) as [F1 F2]. split.
      - intros q. rewrite in_app_iff. intros [Hq | Hq]; auto.
      - apply apart_app. split; [exact F2|]. split; [exact IH2|]. intros v.
        rewrite through_flat, through_flats by apply through_names. apply Ha. }
    destruct H as [H1 H2]. destruct (flat_map flat rs) as [|r [|r' rest]]; try (constructor; auto; fail).
    apply H1. left. reflexivity.
  Qed.

  Lemma Wf_ensure X r ds : Wf X r -> Wf X (ensure_ r ds).
  Proof. intros W. destruct ds; [exact W | constructor; exact W]. Qed.

  Lemma Wf_given X ds r : Wf X r -> Wf X (given ds r).
  Proof.
    induction r; cbn [given]; auto.
    - destruct (has_parameters a); auto. intros _. constructor.
    - intros W. inversion W; subst. apply Wf_ensure. auto.
  Qed.

  Lemma flat_map_nodup (f : residual -> list vehicle) rs :
    (forall r v, In r rs -> In v (f r) -> In v (names r)) -> (forall r, In r rs -> NoDup (f r)) -> apart rs ->
    NoDup (flat_map f rs).
  Proof.
    intros Hf Hn Ha. induction rs as [|r rs IH]; [constructor|]. cbn. destruct Ha as [Ha Hb].
    assert (HN : NoDup (flat_map f rs)).
    { apply IH; auto; intros; [eapply Hf; [right; eassumption | assumption] | apply Hn; right; assumption]. }
    assert (Hr : NoDup (f r)) by (apply Hn; left; reflexivity).
    assert (Hd : forall v, In v (f r) -> ~ In v (flat_map f rs)).
    { intros v Hv Hv'. apply in_flat_map in Hv'. destruct Hv' as (q & Hq & Hv').
      apply (Ha v); [apply (Hf r); [left; reflexivity | exact Hv]|].
      apply in_flat_map. exists q. split; [exact Hq | apply (Hf q); [right; exact Hq | exact Hv']]. }
    clear - HN Hr Hd. induction (f r) as [|v l IH]; [exact HN|]. cbn. inversion Hr; subst. constructor.
    - rewrite in_app_iff. intros [H | H]; [auto | apply (Hd v); [left; reflexivity | exact H]].
    - apply IH; auto. intros u Hu. apply Hd. right. exact Hu.
  Qed.

  Lemma map_flat_map (X Y Z : Type) (g : Y -> Z) (f : X -> list Y) xs :
    map g (flat_map f xs) = flat_map (fun x => map g (f x)) xs.
  Proof. induction xs; cbn; rewrite ?map_app; congruence. Qed.

  (** No vehicle runs two tasks, and none is recruited twice. *)
  Lemma Wf_nodup X r : Wf X r -> NoDup (run_of r) /\ NoDup (recruits r).
  Proof.
    unfold run_of.
    induction 1; cbn; auto; try (split; repeat constructor; auto; fail).
    - split.
      + rewrite map_flat_map. apply flat_map_nodup; [| |exact H1].
        * intros r v Hr Hv. apply running_named. exact Hv.
        * intros r Hr. apply H0. exact Hr.
      + apply flat_map_nodup; [| |exact H1].
        * intros r v Hr Hv. apply recruits_named. exact Hv.
        * intros r Hr. apply H0. exact Hr.
    - destruct IHWf as [H1 H2]. split; [exact H1|]. constructor; auto.
  Qed.

  Lemma Wf_running X r v : Wf X r -> In v (run_of r) -> X v \/ In v (recruits r).
  Proof.
    unfold run_of. intros H. revert v. induction H; cbn; intros u Hu; auto; try contradiction.
    - destruct Hu as [<- | []]. auto.
    - rewrite map_flat_map in Hu. apply in_flat_map in Hu. destruct Hu as (r & Hr & Hu).
      destruct (H0 r Hr u Hu) as [Hx | Hx]; [auto | right; apply in_flat_map; eauto].
    - destruct (IHWf u Hu) as [[Hx | ->] | Hx]; auto.
  Qed.
End Facts.
