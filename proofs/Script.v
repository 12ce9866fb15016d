(** Rules of the script: transitions of configurations, as a relation and as a function; and that they are the same. *)
From Dolphin Require Export Agreement.

Section Script.
  Context {L : Names} {C : Code}.

  (** {1 The end} *)

  (** N has no pairs of fresh keys when the executed task is over. *)
  Definition task_over (S : shared) : shared := with_space (forget_all (space S)) S.

  (** [ended(S, e)]. *)
  Definition ended (S : shared) (e : ending) : configuration :=
    {| control_of := End e; shared_of := task_over (with_bound [] (with_allocation nothing S)) |}.

  Definition ceased (E : list effect) : list timer :=
    flat_map (fun x => match x with Cancel_timer i | Withdraw_question i => [i] | _ => [] end) E.
  Definition left_alone (E : list effect) : list vehicle :=
    flat_map (fun x => match x with Release vs => vs | _ => [] end) E.

  Definition still (S : shared) (vs : list vehicle) : list vehicle :=
    List.filter (fun v => match allocation S v with Some _ => true | None => false end) vs.

  (** The timers that an event ends, and the questions. *)
  Definition spent_numbers (x : option event) : list timer :=
    match x with Some (Expired i) | Some (Answered i _) | Some (Nobody_answers i _) => [i] | _ => [] end.

  (** What the end of [r] asks for, after the effects [E] of the step that comes to it, on the event [x]: the waits that
      remain are cancelled, the plans that remain are stopped, B and the recruited vehicles are released. *)
  Definition stops (x : option event) (r : residual) (E : list effect) (S : shared) : list effect :=
    map ceases (List.filter (fun w => negb (timer_mem (fst w) (spent_numbers x ++ ceased E))) (waits r))
    ++ map Stop (still S (run_of r)).
  Definition end_of (x : option event) (r : residual) (E : list effect) (S : shared) (e : ending) : list effect :=
    E ++ stops x r E S ++ release (bound S ++ minus (recruits r) (left_alone E)) ++ [End_ e].

  (** An error has cut off all that ran. *)
  Definition end_by_error (r : residual) (E : list effect) (S : shared) (e : ending) : list effect :=
    E ++ map Stop (still S (run_of r)) ++ release (bound S) ++ [End_ e].

  (** Where no task runs. *)
  Definition end_here (E : list effect) (S : shared) (e : ending) : list effect := E ++ release (bound S) ++ [End_ e].

  (** {1 Choices of vehicles} *)

  (** [Sub V xs]: [V] is some of [xs], in their order. *)
  Inductive Sub {X : Type} : list X -> list X -> Prop :=
  | Sub_nil : Sub [] []
  | Sub_take : forall x V xs, Sub V xs -> Sub (x :: V) (x :: xs)
  | Sub_skip : forall x V xs, Sub V xs -> Sub V (x :: xs).

  Fixpoint sublists {X : Type} (n : nat) (xs : list X) : list (list X) :=
    match xs with
    | [] => match n with 0 => [[]] | _ => [] end
    | x :: xs => match n with 0 => [] | S n => map (cons x) (sublists n xs) end ++ sublists n xs
    end.

  Lemma in_sublists X (xs : list X) : forall n V, In V (sublists n xs) <-> Sub V xs /\ length V = n.
  Proof.
    induction xs as [|x xs IH]; intros n V.
    - destruct n; cbn; split.
      + intros [<- | []]. split; [constructor | reflexivity].
      + intros [H _]. inversion H. auto.
      + intros [].
      + intros [H E]. inversion H. subst. discriminate.
    - cbn [sublists]. rewrite in_app_iff, IH. split.
      + intros [H | [H <-]]; [|split; [apply Sub_skip; exact H | reflexivity]].
        destruct n; [contradiction|]. apply in_map_iff in H. destruct H as (V' & <- & H).
        apply IH in H. destruct H as [H <-]. split; [apply Sub_take; exact H | reflexivity].
      + intros [H <-]. inversion H; subst.
        * left. cbn [length]. apply in_map. apply IH. auto.
        * right. auto.
  Qed.

  Lemma Sub_incl X (V xs : list X) : Sub V xs -> incl V xs.
  Proof.
    induction 1 as [| x V xs _ IH | x V xs _ IH]; intros y Hy; [contradiction | |].
    - destruct Hy as [<- | Hy]; [left; reflexivity | right; apply IH; exact Hy].
    - right. apply IH. exact Hy.
  Qed.

  (** {1 The relation} *)

  Definition script_at (M : machine) (S : shared) := {| control_of := Script M; shared_of := S |}.
  Definition waits_at (M : machine) (q : waiting) (S : shared) := {| control_of := Wait M q; shared_of := S |}.
  Definition executes (M : machine) (r : residual) (S : shared) := {| control_of := Exec M r; shared_of := S |}.

  Definition machine_of (k : control) : option machine :=
    match k with Script M | Wait M _ | Exec M _ => Some M | End _ => None end.

  (** What waits, and what runs, when the control is left. *)
  Definition residual_of (k : control) : residual := match k with Exec _ r => r | _ => Parallel [] end.
  Definition script_waits (k : control) : list effect :=
    match k with Wait _ (For_pick _) | Wait _ (For_pause _) => [Cancel_timer script_timer] | _ => [] end.
  Definition recruited_by (k : control) : list vehicle := recruits (residual_of k).

  (** [S] where M(T) begins, after the ends of what is cut off. *)
  Definition gone_home (k : control) (S : shared) : shared :=
    task_over (with_bound (bound S ++ recruited_by k) (with_allocation nothing (does (ensured (residual_of k)) S))).

  (** The machine that an interruption goes on with, and its B. *)
  Definition home (k : control) (S : shared) : option machine :=
    match on_interrupt, machine_of k, bound S ++ recruited_by k with
    | Some way, Some M, v :: vs => if leaving M then None else Some (way (v :: vs))
    | _, _, _ => None
    end.

  Definition enough (q : pick) (vs : list vehicle) : bool :=
    match count q with Some n => n <=? length vs | None => match vs with [] => false | _ => true end end.

  Inductive cstep (w : world) : option event -> configuration -> label -> configuration -> list effect -> Prop :=

  (* Deeds *)
  | SCRIPT : forall M S M' s,
      run_script M w S = (Exhausted, M', s) ->
      cstep w None (script_at M S) LScript (script_at M' (with_store s S)) []
  | POST : forall M S M' s ks,
      run_script M w S = (Did (Posted ks), M', s) ->
      cstep w None (script_at M S) (LDid (Posted ks)) (script_at M' (with_code s (post ks (space S)) S)) []
  | CONSUME : forall M S M' s ks N,
      run_script M w S = (Did (Consumed ks), M', s) -> take ks (space S) = Some N ->
      cstep w None (script_at M S) (LDid (Consumed ks)) (script_at M' (with_code s N S)) []
  | MESSAGE : forall M S M' s x,
      run_script M w S = (Did (Said x), M', s) ->
      cstep w None (script_at M S) (LDid (Said x)) (script_at M' (with_store s S)) [Say x]
  | RELEASE : forall M S M' s vs v ws,
      run_script M w S = (Did (Released vs), M', s) -> both (bound S) vs = v :: ws ->
      cstep w None (script_at M S) (LDid (Released (v :: ws)))
        (script_at M' (with_bound (minus (bound S) vs) (with_store s S))) [Release (v :: ws)]
  | SET_TIMEOUT : forall M S M' s vs n,
      run_script M w S = (Did (Timeout_set vs n), M', s) ->
      cstep w None (script_at M S) (LDid (Timeout_set vs n)) (script_at M' (with_store s S))
        [Set_connection_timeout vs n]

  (* Picking vehicles *)
  | PICK : forall M S M' s q,
      run_script M w S = (Asks (Pick q), M', s) ->
      cstep w None (script_at M S) (LPick q) (waits_at M' (For_pick q) (with_store s S)) [Look_for q]
  | PICK_BIND : forall M S q vs,
      Sub vs (fit (asked q) w (bound S)) -> count q = Some (length vs) ->
      cstep w None (waits_at M (For_pick q) S) (LBind vs)
        (script_at (give (vehicles_value vs) M) (with_bound (bound S ++ vs) S))
        [Cancel_timer script_timer; Bind vs]
  | PICK_BIND_all : forall M S q v vs,
      count q = None -> fit (asked q) w (bound S) = v :: vs ->
      cstep w (Some (Expired script_timer)) (waits_at M (For_pick q) S) (LBind (v :: vs))
        (script_at (give (vehicles_value (v :: vs)) M) (with_bound (bound S ++ v :: vs) S)) [Bind (v :: vs)]
  | PICK_ERR : forall M S q,
      enough q (fit (asked q) w (bound S)) = false -> otherwise q = false ->
      cstep w (Some (Expired script_timer)) (waits_at M (For_pick q) S) (LNo_vehicles (no_pick q w S))
        (ended S (Failed (no_pick q w S))) (end_here [] S (Failed (no_pick q w S)))
  | PICK_ELSE : forall M S q,
      enough q (fit (asked q) w (bound S)) = false -> otherwise q = true ->
      cstep w (Some (Expired script_timer)) (waits_at M (For_pick q) S) (LNo_vehicles (no_pick q w S))
        (script_at (give null M) S) []

  (* Waiting *)
  | ASK : forall M S M' s x,
      run_script M w S = (Asks (Ask x), M', s) ->
      cstep w None (script_at M S) (LAsk x) (waits_at M' (For_answer x) (with_store s S)) [Ask_ x]
  | ANSWER : forall M S x text y,
      answer_of text w S = Some y ->
      cstep w (Some (Text text)) (waits_at M (For_answer x) S) (LAnswer text) (script_at (give y M) S) []
  | ANSWER_ERR : forall M S x m,
      cstep w (Some (No_text m)) (waits_at M (For_answer x) S) LNo_answer
        (ended S (Failed (no_text x m))) (end_here [] S (Failed (no_text x m)))
  | PAUSE : forall M S M' s n,
      run_script M w S = (Asks (Pause n), M', s) ->
      cstep w None (script_at M S) (LPause n) (waits_at M' (For_pause n) (with_store s S)) [Set_timer script_timer n]
  | RESUME : forall M S n,
      cstep w (Some (Expired script_timer)) (waits_at M (For_pause n) S) LResume (script_at (give null M) S) []
  | CALL : forall M S M' s c,
      run_script M w S = (Asks (Call c), M', s) ->
      cstep w None (script_at M S) (LCall c) (waits_at M' (For_reply c) (with_store s S)) [Call_ c]
  | REPLY : forall M S c y,
      cstep w (Some (Replied y)) (waits_at M (For_reply c) S) (LReply y) (script_at (give y M) S) []
  | CALL_ERR : forall M S c m,
      cstep w (Some (Host_failed m)) (waits_at M (For_reply c) S) (LNo_reply m)
        (ended S (Failed (no_reply c m))) (end_here [] S (Failed (no_reply c m)))

  (* Inputs *)
  | INPUT : forall k S key x,
      declares key = true -> (forall e, k <> End e) ->
      cstep w (Some (Input key x)) {| control_of := k; shared_of := S |} (LInput key x)
        {| control_of := k; shared_of := with_space (post [(key, x)] (space S)) S |} []

  (* Executing tasks *)
  | EXECUTE : forall M S M' s t r,
      run_script M w S = (Asks (Execute t), M', s) -> alloc w (with_store s S) t = inl r ->
      cstep w None (script_at M S) LExecute (executes M' r (clear (keys r) (with_store s S))) (begun r)
  | ALLOC_ERR : forall M S M' s t m,
      run_script M w S = (Asks (Execute t), M', s) -> alloc w (with_store s S) t = inr m ->
      cstep w None (script_at M S) (LCannot_execute m) (ended (with_store s S) (Failed m)) (end_here [] S (Failed m))
  | EXECUTE_DONE : forall e M S r l S' E,
      step e (alone w) S r l S' Ok E ->
      cstep w e (executes M r S) l (script_at (give null M) (task_over S')) E
  | EXECUTE_ERR : forall e M S r l S' m E,
      step e (alone w) S r l S' (Err m) E ->
      cstep w e (executes M r S) l (ended S' (Failed m)) (end_by_error r E S' (Failed m))
  (* A step of the task that is left; the page needs no name for it. *)
  | EXECUTING : forall e M S r l S' r' E,
      step e (alone w) S r l S' (Next r') E ->
      cstep w e (executes M r S) l (executes M r' S') E

  (* Ends *)
  | END : forall M S M' s,
      run_script M w S = (Finished, M', s) ->
      cstep w None (script_at M S) LEnd (ended (with_store s S) Completed) (end_here [] S Completed)
  | END_interrupted : forall M S M' s,
      run_script M w S = (Left_off, M', s) ->
      cstep w None (script_at M S) LEnd (ended (with_store s S) Interrupted) (end_here [] S Interrupted)
  | HALT_script : forall M S M' s m,
      run_script M w S = (Halts_script m, M', s) ->
      cstep w None (script_at M S) (LHalt m) (ended (with_store s S) (Halted m)) (end_here [] S (Halted m))
  | FAULT : forall M S M' s m,
      run_script M w S = (Faults m, M', s) ->
      cstep w None (script_at M S) (LFault m) (ended (with_store s S) (Failed m)) (end_here [] S (Failed m))
  (* By HALT, ASSERT-ERR or WATCH-HALT of a task. *)
  | ENDS_all : forall e M S r l S' x E,
      step e (alone w) S r l S' (Ends x) E ->
      cstep w e (executes M r S) l (ended S' x) (end_of e r E S' x)
  | INTERRUPT : forall k S,
      (forall e, k <> End e) -> home k S = None ->
      cstep w (Some Interruption) {| control_of := k; shared_of := S |} LInterrupt
        (ended (does (ensured (residual_of k)) S) Interrupted)
        (end_of None (residual_of k) (script_waits k) S Interrupted)
  | ON_INTERRUPT : forall k S M,
      (forall e, k <> End e) -> home k S = Some M ->
      cstep w (Some Interruption) {| control_of := k; shared_of := S |} LInterrupt
        (script_at M (gone_home k S))
        (script_waits k ++ stops None (residual_of k) [] S).

  (** {1 The function} *)

  Inductive ctransition := To (l : label) (c : configuration) (E : list effect).

  Definition script_steps (w : world) (M : machine) (S : shared) : list ctransition :=
    match run_script M w S with
    | (x, M', s) =>
        let on S' l E := [To l (script_at M' S') E] in
        let wait q l E := [To l (waits_at M' q (with_store s S)) E] in
        let ending l e := [To l (ended (with_store s S) e) (end_here [] S e)] in
        match x with
        | Exhausted => on (with_store s S) LScript []
        | Did (Posted ks) => on (with_code s (post ks (space S)) S) (LDid (Posted ks)) []
        | Did (Consumed ks) =>
            match take ks (space S) with Some N => on (with_code s N S) (LDid (Consumed ks)) [] | None => [] end
        | Did (Said x) => on (with_store s S) (LDid (Said x)) [Say x]
        | Did (Released vs) =>
            match both (bound S) vs with
            | [] => []
            | ws => on (with_bound (minus (bound S) vs) (with_store s S)) (LDid (Released ws)) [Release ws]
            end
        | Did (Timeout_set vs n) => on (with_store s S) (LDid (Timeout_set vs n)) [Set_connection_timeout vs n]
        | Asks (Pick q) => wait (For_pick q) (LPick q) [Look_for q]
        | Asks (Ask x) => wait (For_answer x) (LAsk x) [Ask_ x]
        | Asks (Pause n) => wait (For_pause n) (LPause n) [Set_timer script_timer n]
        | Asks (Call c) => wait (For_reply c) (LCall c) [Call_ c]
        | Asks (Execute t) =>
            match alloc w (with_store s S) t with
            | inl r => [To LExecute (executes M' r (clear (keys r) (with_store s S))) (begun r)]
            | inr m => ending (LCannot_execute m) (Failed m)
            end
        | Finished => ending LEnd Completed
        | Left_off => ending LEnd Interrupted
        | Halts_script m => ending (LHalt m) (Halted m)
        | Faults m => ending (LFault m) (Failed m)
        end
    end.

  Definition conclude (x : option event) (M : machine) (r : residual) (t : transition) : ctransition :=
    match t with
    | By l S' (Next r') E => To l (executes M r' S') E
    | By l S' Ok E => To l (script_at (give null M) (task_over S')) E
    | By l S' (Err m) E => To l (ended S' (Failed m)) (end_by_error r E S' (Failed m))
    | By l S' (Ends e) E => To l (ended S' e) (end_of x r E S' e)
    end.

  Definition timed_out (w : world) (M : machine) (q : pick) (S : shared) : list ctransition :=
    let vs := fit (asked q) w (bound S) in
    if enough q vs then
      match count q with
      | Some _ => []
      | None => [To (LBind vs) (script_at (give (vehicles_value vs) M) (with_bound (bound S ++ vs) S)) [Bind vs]]
      end
    else
      let m := no_pick q w S in
      if otherwise q then [To (LNo_vehicles m) (script_at (give null M) S) []]
      else [To (LNo_vehicles m) (ended S (Failed m)) (end_here [] S (Failed m))].

  Definition csteps (w : world) (e : option event) (c : configuration) : list ctransition :=
    let S := shared_of c in
    match control_of c, e with
    | End _, _ => []
    | k, Some Interruption =>
        match home k S with
        | Some M =>
            [To LInterrupt (script_at M (gone_home k S))
               (script_waits k ++ stops None (residual_of k) [] S)]
        | None => [To LInterrupt (ended (does (ensured (residual_of k)) S) Interrupted)
                     (end_of None (residual_of k) (script_waits k) S Interrupted)]
        end
    | Exec M r, Some (Input key x) =>
        (if declares key then
           [To (LInput key x)
              {| control_of := Exec M r; shared_of := with_space (post [(key, x)] (space S)) S |} []] else [])
        ++ map (conclude e M r) (steps e r (alone w) S)
    | k, Some (Input key x) =>
        if declares key then
          [To (LInput key x) {| control_of := k; shared_of := with_space (post [(key, x)] (space S)) S |} []]
        else []
    | Exec M r, e => map (conclude e M r) (steps e r (alone w) S)
    | Script M, None => script_steps w M S
    | Wait M (For_pick q), None =>
        match count q with
        | Some n =>
            map (fun vs => To (LBind vs) (script_at (give (vehicles_value vs) M) (with_bound (bound S ++ vs) S))
                             [Cancel_timer script_timer; Bind vs])
              (sublists n (fit (asked q) w (bound S)))
        | None => []
        end
    | Wait M (For_pick q), Some (Expired i) => if timer_eq i script_timer then timed_out w M q S else []
    | Wait M (For_pause _), Some (Expired i) =>
        if timer_eq i script_timer then [To LResume (script_at (give null M) S) []] else []
    | Wait M (For_answer _), Some (Text text) =>
        match answer_of text w S with Some y => [To (LAnswer text) (script_at (give y M) S) []] | None => [] end
    | Wait M (For_answer x), Some (No_text m) =>
        [To LNo_answer (ended S (Failed (no_text x m))) (end_here [] S (Failed (no_text x m)))]
    | Wait M (For_reply _), Some (Replied y) => [To (LReply y) (script_at (give y M) S) []]
    | Wait M (For_reply c), Some (Host_failed m) =>
        [To (LNo_reply m) (ended S (Failed (no_reply c m))) (end_here [] S (Failed (no_reply c m)))]
    | _, _ => []
    end.

  (** {1 They are the same} *)

  Lemma no_step_by_script_event e K S r t :
    goes (Some e) K S r t ->
    match e with Input _ _ | Interruption | Text _ | No_text _ | Replied _ | Host_failed _ => False | _ => True end.
  Proof.
    intros H. remember (Some e) as e' eqn:He.
    induction H as [K S r t H | K S f r t t' _ IH _]; [|exact IH].
    destruct r; cbn in H; try contradiction; subst e'; cbn in H; try contradiction;
      destruct e; try exact I; try contradiction;
      apply in_each in H; destruct H as (b & x' & after & _ & H); exact H.
  Qed.

  Ltac apart := intros ?; discriminate.

  Lemma csteps_sound w e c l c' E : In (To l c' E) (csteps w e c) -> cstep w e c l c' E.
  Proof.
    intros H.
    assert (Task : forall M r S, c = executes M r S -> In (To l c' E) (map (conclude e M r) (steps e r (alone w) S)) ->
                   cstep w e c l c' E).
    { intros M r S -> Hin. apply in_map_iff in Hin. destruct Hin as ([l0 S' o E0] & Ht & Hin).
      apply function_is_relation in Hin. destruct o; injection Ht as <- <- <-.
      - apply EXECUTING. exact Hin.
      - apply EXECUTE_DONE. exact Hin.
      - apply EXECUTE_ERR. exact Hin.
      - apply ENDS_all. exact Hin. }
    destruct c as [k S]. unfold csteps in H. cbn [control_of shared_of] in H.
    destruct k as [M | M q | M r | x].
    - destruct e as [[]|]; try contradiction.
      + destruct (declares k) eqn:D; [|contradiction]. destruct H as [H | []]. injection H as <- <- <-.
        apply INPUT; [exact D | apart].
      + destruct (home (Script M) S) eqn:Hh; destruct H as [H | []]; injection H as <- <- <-.
        * apply ON_INTERRUPT; [apart | exact Hh].
        * apply INTERRUPT; [apart | exact Hh].
      + unfold script_steps in H. destruct (run_script M w S) as [[x M'] s] eqn:R.
        destruct x as [ | [ks | ks | x | vs | vs n] | [q | x | n | cl | t] | | | m | m];
          try (destruct (alloc w (with_store s S) t) eqn:A);
          cbn in H; try (destruct H as [H | []]; injection H as <- <- <-).
        * eapply SCRIPT; eauto.
        * eapply POST; eauto.
        * destruct (take ks (space S)) eqn:T; [|contradiction]. destruct H as [H | []]; injection H as <- <- <-.
          eapply CONSUME; eauto.
        * eapply MESSAGE; eauto.
        * destruct (both (bound S) vs) eqn:V; [contradiction|]. destruct H as [H | []]; injection H as <- <- <-.
          eapply RELEASE; eauto.
        * eapply SET_TIMEOUT; eauto.
        * eapply PICK; eauto.
        * eapply ASK; eauto.
        * eapply PAUSE; eauto.
        * eapply CALL; eauto.
        * eapply EXECUTE; eauto.
        * eapply ALLOC_ERR; eauto.
        * eapply END; eauto.
        * eapply END_interrupted; eauto.
        * eapply HALT_script; eauto.
        * eapply FAULT; eauto.
    - destruct e as [e|].
      + destruct e; try (destruct q; contradiction).
        * destruct q; try contradiction; (destruct (timer_eq i script_timer) as [->|]; [|contradiction]).
          -- unfold timed_out in H. destruct (enough q (fit (asked q) w (bound S))) eqn:En.
             ++ destruct (count q) eqn:Cq; [contradiction|]. destruct H as [H | []]. injection H as <- <- <-.
                unfold enough in En. rewrite Cq in En. destruct (fit (asked q) w (bound S)) as [|v vs] eqn:F;
                  [discriminate|]. apply PICK_BIND_all; assumption.
             ++ destruct (otherwise q) eqn:Ot; destruct H as [H | []]; injection H as <- <- <-.
                ** apply PICK_ELSE; assumption.
                ** apply PICK_ERR; assumption.
          -- destruct H as [H | []]. injection H as <- <- <-. apply RESUME.
        * destruct q; try contradiction. destruct (answer_of text w S) eqn:Y; [|contradiction].
          destruct H as [H | []]. injection H as <- <- <-. eapply ANSWER; eauto.
        * destruct q; try contradiction. destruct H as [H | []]. injection H as <- <- <-. apply ANSWER_ERR.
        * destruct q; try contradiction. destruct H as [H | []]. injection H as <- <- <-. apply REPLY.
        * destruct q; try contradiction. destruct H as [H | []]. injection H as <- <- <-. apply CALL_ERR.
        * assert (H' : In (To l c' E) (if declares k then
            [To (LInput k x) {| control_of := Wait M q; shared_of := with_space (post [(k, x)] (space S)) S |} []]
            else [])) by (destruct q; exact H).
          clear H. destruct (declares k) eqn:D; [|contradiction]. destruct H' as [H | []]. injection H as <- <- <-.
          apply INPUT; [exact D | apart].
        * assert (H' : In (To l c' E) match home (Wait M q) S with
            | Some M0 => [To LInterrupt
                (script_at M0 (gone_home (Wait M q) S))
                (script_waits (Wait M q) ++ stops None (residual_of (Wait M q)) [] S)]
            | None => [To LInterrupt (ended (does (ensured (residual_of (Wait M q))) S) Interrupted)
                (end_of None (residual_of (Wait M q)) (script_waits (Wait M q)) S Interrupted)] end)
            by (destruct q; exact H).
          clear H. destruct (home (Wait M q) S) eqn:Hh; destruct H' as [H | []]; injection H as <- <- <-.
          -- apply ON_INTERRUPT; [apart | exact Hh].
          -- apply INTERRUPT; [apart | exact Hh].
      + destruct q; try contradiction. destruct (count q) eqn:Cq; [|contradiction].
        apply in_map_iff in H. destruct H as (vs & H & Hin). injection H as <- <- <-.
        apply in_sublists in Hin. destruct Hin as [Hs Hl]. apply PICK_BIND; [exact Hs|]. rewrite Hl. exact Cq.
    - destruct e as [e|]; [destruct e|]; try (eapply Task; [reflexivity | exact H]).
      + apply in_app_iff in H. destruct H as [H | H]; [|eapply Task; [reflexivity | exact H]].
        destruct (declares k) eqn:D; [|contradiction]. destruct H as [H | []]. injection H as <- <- <-.
        apply INPUT; [exact D | apart].
      + destruct (home (Exec M r) S) eqn:Hh; destruct H as [H | []]; injection H as <- <- <-.
        * apply ON_INTERRUPT; [apart | exact Hh].
        * apply INTERRUPT; [apart | exact Hh].
    - contradiction.
  Qed.

  Lemma csteps_complete w e c l c' E : cstep w e c l c' E -> In (To l c' E) (csteps w e c).
  Proof.
    assert (Task : forall e M r S l S' o E, step e (alone w) S r l S' o E ->
      In (conclude e M r (By l S' o E)) (csteps w e (executes M r S))).
    { intros e0 M r S l0 S' o E0 Hs.
      assert (Hg := step_goes _ _ _ _ _ _ _ _ Hs). apply function_is_relation in Hs.
      assert (Hin : In (conclude e0 M r (By l0 S' o E0)) (map (conclude e0 M r) (steps e0 r (alone w) S)))
        by (apply in_map; exact Hs).
      unfold csteps. cbn [executes control_of shared_of].
      destruct e0 as [e0|]; [|exact Hin].
      apply no_step_by_script_event in Hg. destruct e0; try contradiction; exact Hin. }
    destruct 1; try (match goal with H : step _ _ _ _ _ _ _ _ |- _ => apply (@Task _ M _ _ _ _ _ _ H) end);
      unfold csteps, script_steps, timed_out; cbn [script_at waits_at executes control_of shared_of];
      repeat match goal with H : ?x = _ |- context [?x] => rewrite H end;
      try (left; reflexivity).
    - apply in_map_iff. exists vs. split; [reflexivity|]. apply in_sublists. auto.
    - unfold enough. rewrite H. cbn. left. reflexivity.
    - destruct k as [M | M q | M r | x']; [| destruct q | | exfalso; eapply H0; reflexivity];
        left; reflexivity.
    - destruct k as [M | M q | M r | x']; [| destruct q | | exfalso; eapply H; reflexivity]; rewrite ?H0;
        left; reflexivity.
    - destruct k as [M0 | M0 q | M0 r | x']; [| destruct q | | exfalso; eapply H; reflexivity]; rewrite ?H0;
        left; reflexivity.
  Qed.

  (** Of configurations too the function is the relation, for internal transitions and for events. *)
  Theorem configurations_agree w e c l c' E : In (To l c' E) (csteps w e c) <-> cstep w e c l c' E.
  Proof. split; [apply csteps_sound | apply csteps_complete]. Qed.
End Script.
