(** Rules of tasks, as an inductive relation: one constructor for each rule of docs/semantics.md, under its name. A rule
    of the page that is written for two cases has a constructor for each. *)
From Dolphin Require Export Code.

Section Tasks.
  Context {L : Names} {C : Code}.

  (** What becomes of a residual. [Ends] is the end of the whole program, by HALT, ASSERT-ERR or WATCH-HALT. *)
  Inductive outcome := Next (r : residual) | Ok | Err (m : message) | Ends (e : ending).

  (** Where a part is: the world; what it sees as held; what a handler there may not dismiss; what the whole task names
      around the part; the numbers that are taken there; and the vehicles that were recruited for it. *)
  Record context := {
    world_of : world;
    held : vehicle -> bool;
    needed : vehicle -> bool;
    named : vehicle -> bool;
    taken_numbers : list timer;
    its_recruits : list vehicle
  }.

  Definition alone (w : world) : context :=
    {| world_of := w; held := fun _ => false; needed := fun _ => false; named := fun _ => false; taken_numbers := [];
       its_recruits := [] |}.

  (** The context of a part within the frame [f]. *)
  Definition enter (f : frame) (K : context) : context :=
    {| world_of := world_of K;
       held := match f with Beside _ _ => fun v => held K v || mem v (frame_names f) | _ => held K end;
       needed := match f with Held_by _ => needed K | _ => fun v => needed K v || mem v (frame_names f) end;
       named := fun v => named K v || mem v (frame_names f);
       taken_numbers := taken_numbers K ++ frame_numbers f;
       its_recruits := its_recruits K ++ match f with In_recruited v => [v] | _ => [] end |}.

  Definition runs (c : code) (ys : list value) (K : context) (S : shared) : result :=
    run c ys (world_of K) (held K) S.
  Definition handles_error (h : code) (m : message) (K : context) (S : shared) : handled :=
    run_handler h m (world_of K) (held K) (needed K) S.

  (** [S] after code of a handler. *)
  Definition after_handler (s : store) (gone : list vehicle) (N : tuples) (S : shared) : shared :=
    with_bound (minus (bound S) gone) (with_code s N S).

  (** The pairs that a guard took, in the place of [giveBack()]. *)
  Definition given_back (ds : list deed) (es : list end_deed) : list end_deed :=
    flat_map (fun e => match e with
      | Gives_back => map (fun x => Posts (fst x) (snd x)) (taken_pairs ds)
      | e => [e]
      end) es.

  (** What a guard took, for code in the place of a branch's task, and for its end. *)
  Fixpoint given (ds : list deed) (r : residual) : residual :=
    match r with
    | Made a ys q => if has_parameters a then Made a (taken ds) q else r
    | Ensure r es => ensure_ (given ds r) (given_back ds es)
    | r => r
    end.

  (** B for what is made in a part, and those of them that it does not see as held. *)
  Definition its_bound (K : context) (S : shared) : list vehicle := bound S ++ its_recruits K.
  Definition free (K : context) (S : shared) : list vehicle :=
    List.filter (fun v => negb (held K v)) (its_bound K S).

  Definition deeper (q : request) : request :=
    {| allowed := allowed q; place := place q; depth := Datatypes.S (depth q) |}.

  (** Code that runs in a step of the node itself. *)
  Definition own_code (r : residual) : list (code * list value) :=
    match r with
    | Action a => [(a, [])]
    | Condition g | Until _ g _ | Asked _ g _ => [(g, [])]
    | All_of bs | One_of bs => map (fun b => (fst b, [])) bs
    | During_code _ _ d _ => [(d, [])]
    | Made a ys _ => [(a, ys)]
    | _ => []
    end.

  (** The error of a cut, if the cut is an error. *)
  Definition time_out (k : on_cut) (n : seconds) : outcome :=
    match k with Completes => Ok | Fails s => Err (not_in_time s n) end.

  (** [step None K S r l S' o E] is an internal step [S, r --l--> S', o ! E]; [step (Some e)] one that takes event [e]. *)
  Inductive step : option event -> context -> shared -> residual -> label -> shared -> outcome -> list effect -> Prop :=

  (* Platform tasks *)
  | START : forall K S p v,
      step None K S (Ready p v) (LStart v p) (start_on v p S) (Next (Running p v)) [Start p v]
  | DONE : forall K S p v,
      step (Some (Done v)) K S (Running p v) (LDone v p) (without [v] S) Ok []
  | FAIL : forall K S p v m,
      step (Some (Failure v m)) K S (Running p v) (LFail v p m) (without [v] S) (Err (plan_failed p v m)) []

  (* Code *)
  | ACTION : forall K S a x s N ds,
      runs a [] K S = Gives x s N ds ->
      step None K S (Action a) (LAct ds) (with_code s N S) Ok (effects_of ds)
  | ACTION_ERR : forall K S a m ds,
      runs a [] K S = Faulty m ds ->
      step None K S (Action a) (LBroken m) S (Err m) (effects_of (said ds))
  | CONDITION : forall K S g x s N ds,
      runs g [] K S = Gives x s N ds -> truth x = Some true ->
      step None K S (Condition g) (LCheck ds) (with_code s N S) Ok (effects_of ds)
  | CONDITION_ERR : forall K S g m ds,
      runs g [] K S = Faulty m ds -> is_unknown m = false ->
      step None K S (Condition g) (LBroken m) S (Err m) (effects_of (said ds))

  (* Assertions, and halt: they end the program *)
  | ASSERT_ERR : forall K S r c ys m ds,
      In (c, ys) (own_code r) -> runs c ys K S = Asserts m ds ->
      step None K S r (LBroken m) S (Ends (Failed m)) (effects_of (said ds))
  | HALT : forall K S r c ys m s N ds,
      In (c, ys) (own_code r) -> runs c ys K S = Halts m s N ds ->
      step None K S r (LHalt m) (with_code s N S) (Ends (Halted m)) (effects_of ds)
  (* The end of the program is that of everything around; the page needs no rule for it. *)
  | ENDS : forall e K S f r l S' x E,
      step e (enter f K) S r l S' (Ends x) E ->
      step e K S (plug f r) l S' (Ends x) E

  (* One after the other *)
  | SEQ_1 : forall e K S r t l S' r' E,
      step e (enter (In_sequence t) K) S r l S' (Next r') E ->
      step e K S (Sequence r t) l S' (Next (sequence r' t)) E
  | SEQ_2 : forall e K S r t l S' E,
      step e (enter (In_sequence t) K) S r l S' Ok E ->
      step e K S (Sequence r t) l (clear (keys t) S') (Next t) (E ++ begun t)
  | SEQ_ERR : forall e K S r t l S' m E,
      step e (enter (In_sequence t) K) S r l S' (Err m) E ->
      step e K S (Sequence r t) l S' (Err m) E

  (* Side by side *)
  | PAR_1 : forall e K S before r after l S' r' E,
      step e (enter (Beside before after) K) S r l S' (Next r') E ->
      step e K S (Parallel (before ++ r :: after)) l S' (Next (Parallel (before ++ flat r' ++ after))) E
  | PAR_2 : forall e K S before r after l S' E,
      step e (enter (Beside before after) K) S r l S' Ok E ->
      step e K S (Parallel (before ++ r :: after)) l S' (Next (parallel (before ++ after))) E
  | PAR_ERR : forall e K S before r after l S' m E,
      step e (enter (Beside before after) K) S r l S' (Err m) E ->
      step e K S (Parallel (before ++ r :: after)) l
        (does (flat_map ensured (before ++ after)) (without (flat_map run_of (before ++ after)) S')) (Err m)
        (E ++ cut (before ++ after))

  (* Branches with guards *)
  | ALLOF_WHEN : forall K S before g r after x s N ds,
      runs g [] K S = Gives x s N ds -> truth x = Some true ->
      step None K S (All_of (before ++ (g, r) :: after)) (LCheck ds) (clear (keys r) (with_code s N S))
        (Next (branch_of (given ds r) (before ++ after))) (effects_of ds ++ begun r)
  | ALLOF_1 : forall e K S r bs l S' r' E,
      step e (enter (Branch_of bs) K) S r l S' (Next r') E ->
      step e K S (Branch r bs) l S' (Next (Branch r' bs)) E
  | ALLOF_2 : forall e K S r bs l S' E,
      step e (enter (Branch_of bs) K) S r l S' Ok E ->
      step e K S (Branch r bs) l S' (Next (all_of bs)) E
  | ALLOF_ERR : forall e K S r bs l S' m E,
      step e (enter (Branch_of bs) K) S r l S' (Err m) E ->
      step e K S (Branch r bs) l S' (Err m) E
  | ALLOF_ERR_guard : forall K S before g r after m ds,
      runs g [] K S = Faulty m ds -> is_unknown m = false ->
      step None K S (All_of (before ++ (g, r) :: after)) (LBroken m) S (Err m) (effects_of (said ds))
  | ONEOF_WHEN : forall K S before g r after x s N ds,
      runs g [] K S = Gives x s N ds -> truth x = Some true ->
      step None K S (One_of (before ++ (g, r) :: after)) (LCheck ds) (clear (keys r) (with_code s N S))
        (Next (given ds r)) (effects_of ds ++ begun r)
  | ONEOF_ERR : forall K S before g r after m ds,
      runs g [] K S = Faulty m ds -> is_unknown m = false ->
      step None K S (One_of (before ++ (g, r) :: after)) (LBroken m) S (Err m) (effects_of (said ds))

  (* Until and assure *)
  | UNTIL_CUT : forall K S g r x s N ds,
      runs g [] K S = Gives x s N ds -> truth x = Some true ->
      step None K S (Until Completes g r) (LCut ds) (does (ensured r) (without (run_of r) (with_code s N S))) Ok
        (effects_of ds ++ cut [r])
  | ASSURE_CUT : forall K S at_site g r x s N ds,
      runs g [] K S = Gives x s N ds -> truth x = Some false ->
      step None K S (Until (Fails at_site) g r) (LCut []) (does (ensured r) (without (run_of r) S))
        (Err (not_assured at_site g)) (cut [r])
  | UNTIL_1 : forall e K S k g r l S' r' E,
      step e (enter (Body_until k g) K) S r l S' (Next r') E ->
      step e K S (Until k g r) l S' (Next (Until k g r')) E
  | UNTIL_2 : forall e K S k g r l S' E,
      step e (enter (Body_until k g) K) S r l S' Ok E ->
      step e K S (Until k g r) l S' Ok E
  | UNTIL_ERR : forall e K S k g r l S' m E,
      step e (enter (Body_until k g) K) S r l S' (Err m) E ->
      step e K S (Until k g r) l S' (Err m) E
  | UNTIL_ERR_guard : forall K S k g r m ds,
      runs g [] K S = Faulty m ds -> is_unknown m = false ->
      step None K S (Until k g r) (LBroken m) (does (ensured r) (without (run_of r) S)) (Err m)
        (effects_of (said ds) ++ cut [r])

  (* Time *)
  | IDLE_END : forall K S i n,
      step (Some (Expired i)) K S (Idle i n) LTimeout S Ok []
  | DURING_SET : forall K S k i d r x s N ds n,
      runs d [] K S = Gives x s N ds -> time_of d x = inl n ->
      step None K S (During_code k i d r) (LSet_time n) (clear (keys r) (with_code s N S)) (Next (During k i n r))
        (effects_of ds ++ Set_timer i n :: begun r)
  | DURING_CUT : forall K S i n r,
      step (Some (Expired i)) K S (During Completes i n r) LTimeout (does (ensured r) (without (run_of r) S)) Ok
        (cut [r])
  | WITHIN_CUT : forall K S at_site i n r,
      step (Some (Expired i)) K S (During (Fails at_site) i n r) LTimeout (does (ensured r) (without (run_of r) S))
        (Err (not_in_time at_site n)) (cut [r])
  | DURING_1 : forall e K S k i n r l S' r' E,
      step e (enter (Body_during k i n) K) S r l S' (Next r') E ->
      step e K S (During k i n r) l S' (Next (During k i n r')) E
  | DURING_2 : forall e K S k i n r l S' E,
      step e (enter (Body_during k i n) K) S r l S' Ok E ->
      step e K S (During k i n r) l S' Ok (E ++ [Cancel_timer i])
  | DURING_ERR : forall e K S k i n r l S' m E,
      step e (enter (Body_during k i n) K) S r l S' (Err m) E ->
      step e K S (During k i n r) l S' (Err m) (E ++ [Cancel_timer i])
  | DURING_ERR_code : forall K S k i d r m ds,
      runs d [] K S = Faulty m ds ->
      step None K S (During_code k i d r) (LBroken m) S (Err m) (effects_of (said ds))
  | DURING_ERR_time : forall K S k i d r x s N ds m,
      runs d [] K S = Gives x s N ds -> time_of d x = inr m ->
      step None K S (During_code k i d r) (LBroken m) S (Err m) (effects_of (said ds))

  (* Questions *)
  | CONFIRM_YES : forall K S i x at_site,
      step (Some (Answered i true)) K S (Confirm i x at_site) (LAnswered true) S Ok []
  | CONFIRM_NO : forall K S i x at_site,
      step (Some (Answered i false)) K S (Confirm i x at_site) (LAnswered false) S (Err (answered_no at_site x)) []
  | CONFIRM_NO_answer : forall K S i x at_site m,
      step (Some (Nobody_answers i m)) K S (Confirm i x at_site) LNo_answer S (Err (not_answered at_site x m)) []

  (* Errors *)
  | WATCH_1 : forall e K S r h l S' r' E,
      step e (enter (In_watch h) K) S r l S' (Next r') E ->
      step e K S (Watch r h) l S' (Next (Watch r' h)) E
  | WATCH_2 : forall e K S r h l S' E,
      step e (enter (In_watch h) K) S r l S' Ok E ->
      step e K S (Watch r h) l S' Ok E
  | WATCH_IGNORE : forall e K S r h l S' m E s gone N ds,
      step e (enter (In_watch h) K) S r l S' (Err m) E ->
      handles_error (handles h) m K S' = Rules Ignores s gone N ds ->
      step e K S (Watch r h) l (after_handler s gone N S') Ok (E ++ effects_of ds)
  | WATCH_PROPAGATE : forall e K S r h l S' m E s gone N ds,
      step e (enter (In_watch h) K) S r l S' (Err m) E ->
      handles_error (handles h) m K S' = Rules Propagates s gone N ds ->
      step e K S (Watch r h) l (after_handler s gone N S') (Err m) (E ++ effects_of ds)
  | WATCH_PROPAGATE_fault : forall e K S r h l S' m E m' ds,
      step e (enter (In_watch h) K) S r l S' (Err m) E ->
      handles_error (handles h) m K S' = Breaks m' ds ->
      step e K S (Watch r h) l S' (Err m') (E ++ effects_of (said ds))
  | WATCH_PROPAGATE_foreign : forall e K S r h l S' m E s gone N ds x,
      step e (enter (In_watch h) K) S r l S' (Err m) E ->
      handles_error (handles h) m K S' = Rules x s gone N ds ->
      anew h = None -> x = Retries ->
      step e K S (Watch r h) l (after_handler s gone N S') (Err (foreign_retry (handles h))) (E ++ effects_of ds)
  | WATCH_PROPAGATE_deep : forall e K S r h l S' m E s gone N ds t u q,
      step e (enter (In_watch h) K) S r l S' (Err m) E ->
      handles_error (handles h) m K S' = Rules (Instead t) s gone N ds ->
      anew h = Some (u, q) -> deepest <= depth q ->
      step e K S (Watch r h) l (after_handler s gone N S') (Err (too_deep (handles h))) (E ++ effects_of ds)
  (* The value of a handler that cannot recover is not looked at. *)
  | WATCH_PROPAGATE_value : forall e K S r h l S' m E s gone N ds t,
      step e (enter (In_watch h) K) S r l S' (Err m) E ->
      handles_error (handles h) m K S' = Rules (Instead t) s gone N ds ->
      anew h = None ->
      step e K S (Watch r h) l (after_handler s gone N S') (Err m) (E ++ effects_of ds)
  | WATCH_HALT : forall e K S r h l S' m E m' s gone N ds,
      step e (enter (In_watch h) K) S r l S' (Err m) E ->
      handles_error (handles h) m K S' = Halts_ m' s gone N ds ->
      step e K S (Watch r h) l (after_handler s gone N S') (Ends (Halted m')) (E ++ effects_of ds)
  | ASSERT_ERR_handler : forall e K S r h l S' m E m' ds,
      step e (enter (In_watch h) K) S r l S' (Err m) E ->
      handles_error (handles h) m K S' = Asserts_ m' ds ->
      step e K S (Watch r h) l S' (Ends (Failed m')) (E ++ effects_of (said ds))
  | WATCH_RETRY : forall e K S r h l S' m E s gone N ds t q,
      step e (enter (In_watch h) K) S r l S' (Err m) E ->
      handles_error (handles h) m K S' = Rules Retries s gone N ds ->
      anew h = Some (t, q) ->
      step e K S (Watch r h) l (after_handler s gone N S') (Next (Watch (Unallocated t q) h)) (E ++ effects_of ds)
  | WATCH_INSTEAD : forall e K S r h l S' m E s gone N ds t u q,
      step e (enter (In_watch h) K) S r l S' (Err m) E ->
      handles_error (handles h) m K S' = Rules (Instead t) s gone N ds ->
      anew h = Some (u, q) -> depth q < deepest ->
      step e K S (Watch r h) l (after_handler s gone N S') (Next (Unallocated t (deeper q))) (E ++ effects_of ds)

  (* Rounds *)
  | REPEAT_1 : forall e K S r more g t l S' r' E,
      step e (enter (Round_of more g t) K) S r l S' (Next r') E ->
      step e K S (Repeat r more g t) l S' (Next (Repeat r' more g t)) E
  | REPEAT_2 : forall e K S r more t l S' E,
      step e (enter (Round_of more None t) K) S r l S' Ok E ->
      step e K S (Repeat r more None t) l (clear (keys t) S') (Next (repeat_ t (option_map pred more) None t))
        (E ++ begun t)
  | REPEAT_2_condition : forall e K S r more g t l S' E,
      step e (enter (Round_of more (Some g) t) K) S r l S' Ok E ->
      step e K S (Repeat r more (Some g) t) l S' (Next (Asked more g t)) E
  | REPEAT_UNTIL : forall K S more g t x s N ds,
      runs g [] K S = Gives x s N ds -> truth x = Some true ->
      step None K S (Asked more g t) (LCheck ds) (with_code s N S) Ok (effects_of ds)
  | REPEAT_AGAIN : forall K S more g t x s N ds,
      runs g [] K S = Gives x s N ds -> truth x = Some false ->
      step None K S (Asked more g t) (LCheck []) (clear (keys t) S)
        (Next (repeat_ t (option_map pred more) (Some g) t)) (begun t)
  | REPEAT_ERR : forall e K S r more g t l S' m E,
      step e (enter (Round_of more g t) K) S r l S' (Err m) E ->
      step e K S (Repeat r more g t) l S' (Err m) E
  | REPEAT_ERR_guard : forall K S more g t m ds,
      runs g [] K S = Faulty m ds -> is_unknown m = false ->
      step None K S (Asked more g t) (LBroken m) S (Err m) (effects_of (said ds))

  (* Tasks made at their turn *)
  | MAKE : forall K S a ys q x s N ds t,
      runs a ys K S = Gives x s N ds -> made_task a ys q S x s ds = Some t ->
      step None K S (Made a ys q) LMake S (Next (Unallocated t (deeper q))) []
  | MAKE_ERR : forall K S a ys q m ds,
      runs a ys K S = Faulty m ds ->
      step None K S (Made a ys q) (LBroken m) S (Err m) (effects_of (said ds))
  | MAKE_ERR_value : forall K S a ys q x s N ds,
      runs a ys K S = Gives x s N ds -> made_task a ys q S x s ds = None ->
      step None K S (Made a ys q) (LBroken (no_task a ys (depth q) (variables S) x s ds)) S
        (Err (no_task a ys (depth q) (variables S) x s ds)) []
  | ALLOCATE : forall K S t q vs r,
      alloc_made (world_of K) (held K) S (free K S) t q (taken_numbers K) = inl (vs, r) ->
      step None K S (Unallocated t q) (LAllocate vs) (clear (keys r) S) (Next (holding vs r)) (begun r)
  | ALLOCATE_ERR : forall K S t q m,
      alloc_made (world_of K) (held K) S (its_bound K S) t q (taken_numbers K) = inr m ->
      step None K S (Unallocated t q) (LCannot_execute m) S (Err m) []
  | HOLD_1 : forall e K S vs r l S' r' E,
      step e (enter (Held_by vs) K) S r l S' (Next r') E ->
      step e K S (Holding vs r) l S' (Next (Holding vs r')) E
  | HOLD_2 : forall e K S vs r l S' E,
      step e (enter (Held_by vs) K) S r l S' Ok E ->
      step e K S (Holding vs r) l S' Ok E
  | HOLD_ERR : forall e K S vs r l S' m E,
      step e (enter (Held_by vs) K) S r l S' (Err m) E ->
      step e K S (Holding vs r) l S' (Err m) E

  (* Recruits *)
  | RECRUIT : forall K S i q a j d v,
      In v (fit q (world_of K) (bound S)) -> named K v = false ->
      step (Some (Comes i v)) K S (Recruit i q a j d) (LRecruit v) S
        (Next (Recruited v (Made a [vehicle_value v] {| allowed := Some [v]; place := j; depth := d |}))) [Bind [v]]
  | RECRUIT_1 : forall e K S v r l S' r' E,
      step e (enter (In_recruited v) K) S r l S' (Next r') E ->
      step e K S (Recruited v r) l S' (Next (Recruited v r')) E
  | RECRUIT_2 : forall e K S v r l S' E,
      step e (enter (In_recruited v) K) S r l S' Ok E ->
      step e K S (Recruited v r) l S' Ok (E ++ [Release [v]])
  | RECRUIT_ERR : forall e K S v r l S' m E,
      step e (enter (In_recruited v) K) S r l S' (Err m) E ->
      step e K S (Recruited v r) l S' (Err m) (E ++ [Release [v]])

  (* Fresh keys *)
  | FRESH_1 : forall e K S ks r l S' r' E,
      step e (enter (With_keys ks) K) S r l S' (Next r') E ->
      step e K S (Fresh ks r) l S' (Next (Fresh ks r')) E
  | FRESH_2 : forall e K S ks r l S' E,
      step e (enter (With_keys ks) K) S r l S' Ok E ->
      step e K S (Fresh ks r) l (clear ks S') Ok E
  | FRESH_ERR : forall e K S ks r l S' m E,
      step e (enter (With_keys ks) K) S r l S' (Err m) E ->
      step e K S (Fresh ks r) l (clear ks S') (Err m) E

  (* Ends *)
  | ENSURE_1 : forall e K S ds r l S' r' E,
      step e (enter (Ensuring ds) K) S r l S' (Next r') E ->
      step e K S (Ensure r ds) l S' (Next (Ensure r' ds)) E
  | ENSURE_2 : forall e K S ds r l S' E,
      step e (enter (Ensuring ds) K) S r l S' Ok E ->
      step e K S (Ensure r ds) l (does ds S') Ok E
  | ENSURE_ERR : forall e K S ds r l S' m E,
      step e (enter (Ensuring ds) K) S r l S' (Err m) E ->
      step e K S (Ensure r ds) l (does ds S') (Err m) E.
End Tasks.
