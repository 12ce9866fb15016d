(** Laws of rounds inside of rounds. *)
From Dolphin Require Import Laws.
Set Implicit Arguments.
Unset Strict Implicit.

Section Rounds.
  Context {L : Names} {C : Code}.

  Lemma repeat_some r x g t : 1 <= x -> repeat_ r (Some x) g t = Repeat r (Some x) g t.
  Proof. intros H. destruct x; [lia | reflexivity]. Qed.

  (** [k] rounds to come, and then [more] times [n]. *)
  Definition total (k : nat) (more : option nat) (n : nat) : option nat := option_map (fun j => k + j * n) more.

  Definition times (n : nat) (t a b : residual) : Prop :=
    exists r k more, normal r = true /\ some_left more = true /\
      a = Repeat (repeat_ r (Some k) None t) more None (repeat_ t (Some (pred n)) None t) /\
      b = Repeat r (total k more n) None t.

  Lemma times_step n t a b : 1 <= n -> normal t = true -> times n t a b ->
    face a b /\ simulates (up (times n t)) a b /\ simulates (up (fun a b => times n t b a)) b a.
  Proof.
    intros Hn Ht (r & k & more & Hr & Hj & -> & ->). set (N := repeat_ t (Some (pred n)) None t).
    assert (NN : normal N = true) by (apply normal_repeat; exact Ht).
    assert (A1 : alike (names N) (names t)) by (apply (alike_repeat (f := names)); intros; apply alike_refl).
    assert (A3 : alike (numbers N) (numbers t)) by (apply (alike_repeat (f := numbers)); intros; apply alike_refl).
    assert (A4 : keys N = keys t) by apply keys_repeat.
    assert (Hx : some_left (total k more n) = true).
    { destruct more as [[|j]|]; try discriminate; [|reflexivity]. cbn [total option_map some_left].
      destruct (k + Datatypes.S j * n) eqn:E; [cbn in E; lia | reflexivity]. }
    assert (F : face (Repeat (repeat_ r (Some k) None t) more None N) (Repeat r (total k more n) None t)).
    { split.
      - intros v. specialize (A1 v). destruct k; cbn [names repeat_]; rewrite !in_app_iff; tauto.
      - destruct k; apply alike_refl.
      - intros i. specialize (A3 i). destruct k; cbn [numbers repeat_]; rewrite !in_app_iff; tauto.
      - cbn [normal]. rewrite Hj, NN, normal_repeat by assumption. reflexivity.
      - cbn [normal]. rewrite Hx, Hr, Ht. reflexivity.
      - change (alike (keys (repeat_ r (Some k) None t)) (keys r)). rewrite keys_repeat. apply alike_refl.
      - intros S. cbn [ensured]. rewrite ensured_repeat. reflexivity. }
    (* After a round of [t]. *)
    assert (Inner : forall k', k = Datatypes.S k' -> times n t (Repeat (repeat_ t (Some k') None t) more None N)
      (repeat_ t (option_map pred (total k more n)) None t)).
    { intros k' ->. exists t, k', more. split; [exact Ht | split; [exact Hj | split; [reflexivity|]]].
      destruct more as [[|j]|]; try discriminate; [|reflexivity]. cbn [total option_map Nat.add pred].
      apply repeat_some. cbn. lia. }
    (* After the last of [n] rounds. *)
    assert (Outer : k = 0 ->
      repeat_ N (option_map pred more) None N = repeat_ t (option_map pred (total k more n)) None t \/
      times n t (repeat_ N (option_map pred more) None N) (repeat_ t (option_map pred (total k more n)) None t)).
    { intros ->. destruct more as [[|[|j]]|]; try discriminate; [left | right | right]; cbn [total option_map].
      - cbn [pred Nat.add Nat.mul]. rewrite Nat.add_0_r. reflexivity.
      - exists t, (pred n), (Some (Datatypes.S j)). split; [exact Ht | split; [reflexivity | split; [reflexivity|]]].
        cbn [total option_map].
        replace (pred (0 + Datatypes.S (Datatypes.S j) * n)) with (pred n + Datatypes.S j * n)
          by (destruct n; cbn; lia).
        apply repeat_some. destruct n; cbn; lia.
      - exists t, (pred n), None. split; [exact Ht | split; [reflexivity | split; reflexivity]]. }
    assert (Ctx : forall K v e S, goes e (enter (Round_of (total k more n) None t) K) S r v <->
      goes e (match k with
              | 0 => enter (Round_of more None N) K
              | Datatypes.S _ => enter (Round_of (Some k) None t) (enter (Round_of more None N) K)
              end) S r v).
    { intros K v e S.
      assert (Sim : similar (enter (Round_of (total k more n) None t) K)
        (match k with
         | 0 => enter (Round_of more None N) K
         | Datatypes.S _ => enter (Round_of (Some k) None t) (enter (Round_of more None N) K)
         end)).
      { destruct k as [|k'].
        - apply enter_alike; [reflexivity | apply alike_sym; exact A1 | apply alike_sym; exact A3].
        - apply similar_sym.
          assert (P1 : is_around (Round_of (Some (Datatypes.S k')) None t) (names t) (numbers t))
            by (repeat split; apply alike_refl).
          assert (P2 : is_around (Round_of more None N) (names N) (numbers N)) by (repeat split; apply alike_refl).
          assert (P3 : is_around (Round_of (total (Datatypes.S k') more n) None t) (names t ++ names N)
            (numbers t ++ numbers N)).
          { split; [reflexivity | split; intros y; rewrite in_app_iff; cbn [frame_names frame_numbers];
              [specialize (A1 y) | specialize (A3 y)]; tauto]. }
          eapply enter_two; [exact P1 | exact P2 | exact P3]. }
      split; intros H; eapply goes_similar; try exact H; [exact Sim | apply similar_sym; exact Sim]. }
    assert (Down : forall y, repeat_ y (Some k) None t =
      match k with 0 => y | Datatypes.S _ => plug (Round_of (Some k) None t) y end)
      by (intros y; destruct k; reflexivity).
    (* The steps of the left are those of [r], as the frames carry them. *)
    assert (Steps : forall e K S u, goes e K S (Repeat (repeat_ r (Some k) None t) more None N) u <->
      exists v, goes e (enter (Round_of (total k more n) None t) K) S r v /\
        In u match v with
             | By l S1 (Next y) E => [By l S1 (Next (Repeat (repeat_ y (Some k) None t) more None N)) E]
             | By l S1 Ok E =>
                 [By l (clear (keys t) S1)
                    (Next match k with
                          | 0 => repeat_ N (option_map pred more) None N
                          | Datatypes.S k' => Repeat (repeat_ t (Some k') None t) more None N
                          end) (E ++ begun t)]
             | By l S1 o E => [By l S1 o E]
             end).
    { intros e K S u. change (Repeat (repeat_ r (Some k) None t) more None N)
        with (plug (Round_of more None N) (repeat_ r (Some k) None t)).
      rewrite goes_plug by reflexivity. cbn [plug own].
      assert (B : begun N = begun t) by (unfold begun, N; rewrite waits_repeat; reflexivity).
      setoid_rewrite Ctx. rewrite Down. destruct k as [|k'].
      - split.
        + intros [[] | (v & Hv & Hu)]. exists v. split; [exact Hv|].
          destruct v as [l S1 [y | | m | y] E]; cbn [lift on_ok on_err replug option_map] in Hu;
            rewrite ?A4, ?B in Hu; exact Hu.
        + intros (v & Hv & Hu). right. exists v. split; [exact Hv|].
          destruct v as [l S1 [y | | m | y] E]; cbn [lift on_ok on_err replug option_map]; rewrite ?A4, ?B; exact Hu.
      - split.
        + intros [[] | (w & Hw & Hu)]. apply goes_plug in Hw; [|reflexivity]. destruct Hw as [[] | (v & Hv & Hw)].
          exists v. split; [exact Hv|].
          destruct v as [l S1 [y | | m | y] E]; destruct Hw as [<- | []]; exact Hu.
        + intros (v & Hv & Hu). right.
          destruct v as [l S1 [y | | m | y] E]; (eexists; split; [apply goes_plug; [reflexivity|]; right;
            eexists; split; [exact Hv | left; reflexivity] | exact Hu]). }
    split; [exact F | split; intros e K S u Hu].
    - apply Steps in Hu. destruct Hu as (v & Hv & Hu). assert (Nv := goes_normal Hv Hr).
      assert (Step : forall u', In u' (lift (Round_of (total k more n) None t) K v) ->
        goes e K S (Repeat r (total k more n) None t) u').
      { intros u' Hu'. change (Repeat r (total k more n) None t) with (plug (Round_of (total k more n) None t) r).
        eapply Within; eassumption. }
      destruct v as [l S1 [y | | m | y] E]; destruct Hu as [<- | []];
        (eexists; split; [apply Step; left; reflexivity|]);
        (split; [reflexivity | split; [reflexivity|]]); auto.
      + left. exists y, k, more. auto.
      + cbn [option_map]. destruct k as [|k'].
        * destruct (Outer eq_refl) as [-> | H]; [apply up_refl, normal_repeat; exact Ht | left; exact H].
        * left. apply Inner. reflexivity.
    - change (Repeat r (total k more n) None t) with (plug (Round_of (total k more n) None t) r) in Hu.
      apply goes_plug in Hu; [|reflexivity]. destruct Hu as [[] | (v & Hv & Hu)].
      assert (Nv := goes_normal Hv Hr).
      destruct v as [l S1 [y | | m | y] E]; destruct Hu as [<- | []];
        (eexists; split; [apply Steps; eexists; split; [exact Hv | left; reflexivity]|]);
        (split; [reflexivity | split; [reflexivity|]]); auto.
      + left. exists y, k, more. auto.
      + cbn [option_map]. destruct k as [|k'].
        * destruct (Outer eq_refl) as [-> | H]; [apply up_refl, normal_repeat; exact Ht | left; exact H].
        * left. apply Inner. reflexivity.
  Qed.

  (** [repeat m, repeat n, t = repeat m * n, t], and [repeat repeat n, t = repeat t] *)
  Theorem repeat_times more n t : some_left more = true -> 1 <= n -> normal t = true ->
    let rounds := repeat_ t (Some (pred n)) None t in
    bisimilar (Repeat rounds more None rounds) (repeat_ t (total (pred n) more n) None t).
  Proof.
    intros Hm Hn Ht rounds. apply (@by_relation _ _ (times n t)).
    - intros a b H. apply times_step; assumption.
    - exists t, (pred n), more. split; [exact Ht | split; [exact Hm | split; [reflexivity|]]].
      destruct more as [[|j]|]; try discriminate; [|reflexivity]. apply repeat_some. destruct n; cbn; lia.
  Qed.
End Rounds.
