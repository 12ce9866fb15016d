(** Code, as the rules see it: a partial function of store, tuple space and world to a result and deeds; and what else
    the rules leave to others: allocation's choice, vehicles that fit, texts of messages, the script's machine. The
    hypotheses about them are the fields that end in [_law]. *)
From Dolphin Require Export Configurations.

Section Allocation.
  Context {L : Names}.

  (** [t[V]] for a [t] that is restricted to [allowed] already. *)
  Definition restrict (ok : option (list vehicle)) (vs : list vehicle) : option (list vehicle) :=
    match ok with None => Some vs | Some ws => Some (both vs ws) end.

  (** [chosen t f k] is the vehicles of the platform tasks of [t], left to right, the first of which is the [k]-th. *)
  Definition chosen (t : task) (f : nat -> vehicle) (k : nat) : list vehicle := map f (seq k (leaves t)).

  (** The choice [f] of vehicles of [B] for [t] is feasible: each is one of [B] and of the [V] of each [t'[V]] around its
      platform task, and tasks in different branches of a [|] have different vehicles. *)
  Fixpoint feasible (B : list vehicle) (ok : option (list vehicle)) (t : task) (f : nat -> vehicle) (k : nat) : Prop :=
    match t with
    | TPlan _ => In (f k) B /\ match ok with None => True | Some vs => In (f k) vs end
    | TAction _ | TCondition _ | TIdle _ | TConfirm _ _ | TMade _ | TRecruit _ _ | TFresh _ => True
    | TSequence a b => feasible B ok a f k /\ feasible B ok b f (k + leaves a)
    | TParallel a b =>
        feasible B ok a f k /\ feasible B ok b f (k + leaves a) /\
        forall v, In v (chosen a f k) -> ~ In v (chosen b f (k + leaves a))
    | TAllocated a vs => feasible B (restrict ok vs) a f k
    | TUntil _ _ a | TDuring _ _ a | TWatch a _ | TRepeat _ _ a | TKeys _ _ a | TEnsure a _ => feasible B ok a f k
    | TAll_of bs | TOne_of bs =>
        (fix branches (bs : list (code * task)) (k : nat) : Prop :=
           match bs with
           | [] => True
           | (_, a) :: bs => feasible B ok a f k /\ branches bs (k + leaves a)
           end) bs k
    end.
End Allocation.

(** What code of a task gives. [Asserts] is a fault of an assertion; [Unclear] has no step. *)
Inductive result {L : Names} :=
| Gives (x : value) (s : store) (N : tuples) (ds : list deed)
| Faulty (m : message) (ds : list deed)
| Asserts (m : message) (ds : list deed)
| Halts (m : message) (s : store) (N : tuples) (ds : list deed)
| Unclear.

(** The verdict of a handler: that of the last of [ignore()], [propagate()] and [retry()] it called, or a task. *)
Inductive verdict {L : Names} := Ignores | Propagates | Retries | Instead (t : task).

(** Code of a handler may dismiss vehicles: [gone] is taken out of B. *)
Inductive handled {L : Names} :=
| Rules (x : verdict) (s : store) (gone : list vehicle) (N : tuples) (ds : list deed)
| Breaks (m : message) (ds : list deed)
| Asserts_ (m : message) (ds : list deed)
| Halts_ (m : message) (s : store) (gone : list vehicle) (N : tuples) (ds : list deed)
| Unclear_.

(** What the script's machine comes to in one step. *)
Inductive stop {L : Names} :=
| Exhausted                              (* 10,000 expressions without a deed *)
| Did (d : deed)
| Asks (q : request_of_script)
| Finished
| Left_off                               (* the end of what onInterrupt executes *)
| Halts_script (m : message)
| Faults (m : message).

Class Code {L : Names} := {
  (** The deeds that ends of the program's tasks may do. *)
  may_ensure : end_deed -> bool;
  give_back_law : may_ensure Gives_back = true -> forall k x, may_ensure (Posts k x) = true;

  (** [run c ys w held S]: [held] is what the part sees as held. *)
  run : code -> list value -> world -> (vehicle -> bool) -> shared -> result;
  (** [run_handler h m w held needed S]: [needed] is what the handler may not dismiss. *)
  run_handler : code -> message -> world -> (vehicle -> bool) -> (vehicle -> bool) -> shared -> handled;
  handler_law : forall h m w held needed S x s gone N ds,
    run_handler h m w held needed S = Rules x s gone N ds -> forall v, In v gone -> needed v = false;
  handler_task_law : forall h m w held needed S t s gone N ds,
    run_handler h m w held needed S = Rules (Instead t) s gone N ds -> solid_with may_ensure t = true;

  truth : value -> option bool;                        (* None: unknown *)
  is_unknown : message -> bool;                        (* a fault of code that needs what is unknown *)
  time_of : code -> value -> seconds + message;        (* of the code of a during or within *)
  task_of : value -> option task;                      (* a task, or code in the place of one *)
  task_law : forall x t, task_of x = Some t -> solid_with may_ensure t = true;
  takes : code -> list value -> bool;                  (* whether the code has enough values *)
  parameters : code -> nat;
  may_recover : code -> bool;
  vehicle_value : vehicle -> value;                    (* {v} *)
  key_value : timer -> value;                          (* #i *)
  forget : list timer -> tuples -> tuples;             (* N without the pairs of these keys *)
  forget_law : forall ks ks' N, (forall i, In i ks <-> In i ks') -> forget ks N = forget ks' N;
  forget_twice_law : forall ks ks' N, forget ks' (forget ks N) = forget (ks ++ ks') N;
  forget_all : tuples -> tuples;                       (* N without the pairs of such keys *)
  assign_to : assignment -> store -> store;            (* v = x *)

  fit : filter -> world -> list vehicle -> list vehicle;
  fit_law : forall q w B v, In v (fit q w B) -> ~ In v B;
  fit_once_law : forall q w B, NoDup (fit q w B);

  (** The best choice of vehicles of B for a task, or why there is none. More vehicles never hurt. *)
  assign : world -> list vehicle -> option (list vehicle) -> task -> (nat -> vehicle) + message;
  assign_law : forall w B ok t f, assign w B ok t = inl f -> feasible B ok t f 0;
  assign_more_law : forall w B B' ok t f m,
    assign w B ok t = inl f -> incl B B' -> assign w B' ok t = inr m -> False;

  (** Messages. *)
  not_assured : site -> code -> message;               (* assure: g does not hold *)
  not_in_time : site -> seconds -> message;            (* not done within n s *)
  answered_no : site -> prompt -> message;             (* 'x' was answered no *)
  not_answered : site -> prompt -> message -> message; (* no answer to 'x': m *)
  plan_failed : plan -> vehicle -> message -> message;
  no_task : code -> list value -> nat -> store -> value -> store -> list deed -> message;  (* the stores before, after *)
  no_opened_task : code -> list value -> nat -> store -> result -> message;  (* of the code of a fresh *)
  too_deep : code -> message;
  foreign_retry : code -> message;

  (** The script. *)
  run_script : machine -> world -> shared -> stop * machine * store;
  script_task_law : forall M w S t M' s,
    run_script M w S = (Asks (Execute t), M', s) -> solid_with may_ensure t = true;
  give : value -> machine -> machine;                  (* M(x) *)
  null : value;
  vehicles_value : list vehicle -> value;
  post : list (key * value) -> tuples -> tuples;
  take : list (key * value) -> tuples -> option tuples;
  answer_of : prompt -> world -> shared -> option value;
  no_pick : pick -> world -> shared -> message;
  no_text : prompt -> message -> message;
  no_reply : host_call -> message -> message;
  declares : key -> bool;                              (* input 'k' *)
  on_interrupt : option (list vehicle -> machine);     (* M(T) *)
  leaving : machine -> bool                            (* whether the machine is one that M(T) has become *)
}.

(** Closures in tasks that closures made, and tasks in the place of tasks that failed, nest so deep. *)
Definition deepest : nat.
Proof. exact 100. Qed.

Notation solid := (solid_with may_ensure).

Section Building.
  Context {L : Names} {C : Code}.

  (** {1 Ends} *)

  Definition assigned (ds : list end_deed) (s : store) : store :=
    fold_left (fun s d => match d with Assigns x => assign_to x s | _ => s end) ds s.
  Definition posted (ds : list end_deed) (N : tuples) : tuples :=
    fold_left (fun N d => match d with Posts k x => post [(k, x)] N | _ => N end) ds N.

  (** [S + D]. *)
  Definition does (ds : list end_deed) (S : shared) : shared :=
    {| variables := assigned ds (variables S); allocation := allocation S; bound := bound S;
       space := posted ds (space S) |}.

  (** [S] where [r] begins: N has no pairs of its keys. *)
  Definition clear (ks : list timer) (S : shared) : shared := with_space (forget ks (space S)) S.

  Definition has_parameters (c : code) : bool := 0 <? parameters c.

  (** {1 Fresh keys}

      [open(t)]: the code of each [fresh] runs, from left to right, and each gets the next keys; [n] were given
      before. *)

  Section Opening.
    Variable inside : code -> nat -> (task * nat) + message.

    Fixpoint open_each (t : task) (n : nat) : (task * nat) + message :=
      let one (f : task -> task) a := match open_each a n with inl (a', n') => inl (f a', n') | inr m => inr m end in
      let two (f : task -> task -> task) a b :=
        match open_each a n with
        | inl (a', n1) => match open_each b n1 with inl (b', n2) => inl (f a' b', n2) | inr m => inr m end
        | inr m => inr m
        end in
      let branches (f : list (code * task) -> task) bs :=
        match
          (fix each (bs : list (code * task)) (n : nat) : (list (code * task) * nat) + message :=
             match bs with
             | [] => inl ([], n)
             | (g, a) :: bs =>
                 match open_each a n with
                 | inl (a', n1) => match each bs n1 with inl (bs', n2) => inl ((g, a') :: bs', n2) | inr m => inr m end
                 | inr m => inr m
                 end
             end) bs n
        with inl (bs', n') => inl (f bs', n') | inr m => inr m end in
      match t with
      | TPlan _ | TAction _ | TCondition _ | TIdle _ | TConfirm _ _ | TMade _ | TRecruit _ _ => inl (t, n)
      | TSequence a b => two TSequence a b
      | TParallel a b => two TParallel a b
      | TAllocated a vs => one (fun a => TAllocated a vs) a
      | TAll_of bs => branches TAll_of bs
      | TOne_of bs => branches TOne_of bs
      | TUntil k g a => one (TUntil k g) a
      | TDuring k d a => one (TDuring k d) a
      | TWatch a h => one (fun a => TWatch a h) a
      | TRepeat m g a => one (TRepeat m g) a
      | TEnsure a ds => one (fun a => TEnsure a ds) a
      | TFresh c => inside c n
      | TKeys ks c a => inside c n
      end.
  End Opening.

  (** {1 The residual of a task whose vehicles are chosen}

      Platform task [k] gets vehicle [f k]. [number a b] is the next number where [a] timers and [b] places were numbered
      before, [spot a b] the next place. *)

  Record supply := {
    choice : nat -> vehicle;
    number : nat -> nat -> timer;
    spot : nat -> nat -> timer;
    deep : nat
  }.

  Fixpoint timers (t : task) : nat :=
    match t with
    | TPlan _ | TAction _ | TCondition _ | TMade _ | TFresh _ => 0
    | TIdle _ | TConfirm _ _ | TRecruit _ _ => 1
    | TSequence a b | TParallel a b => timers a + timers b
    | TAllocated a _ | TUntil _ _ a | TWatch a _ | TRepeat _ _ a | TKeys _ _ a | TEnsure a _ => timers a
    | TDuring _ _ a => 1 + timers a
    | TAll_of bs | TOne_of bs => list_sum (map (fun b => timers (snd b)) bs)
    end.

  Fixpoint places (t : task) : nat :=
    match t with
    | TPlan _ | TAction _ | TCondition _ | TIdle _ | TConfirm _ _ => 0
    | TMade _ | TRecruit _ _ | TFresh _ => 1
    | TSequence a b | TParallel a b => places a + places b
    | TAllocated a _ | TUntil _ _ a | TRepeat _ _ a | TDuring _ _ a | TKeys _ _ a | TEnsure a _ => places a
    | TWatch a h => (if may_recover h then 1 else 0) + places a
    | TAll_of bs | TOne_of bs => list_sum (map (fun b => places (snd b)) bs)
    end.

  (** A handler that retries its task opens it again. *)
  Fixpoint unopened (t : task) : task :=
    match t with
    | TPlan _ | TAction _ | TCondition _ | TIdle _ | TConfirm _ _ | TMade _ | TRecruit _ _ | TFresh _ => t
    | TSequence a b => TSequence (unopened a) (unopened b)
    | TParallel a b => TParallel (unopened a) (unopened b)
    | TAllocated a vs => TAllocated (unopened a) vs
    | TAll_of bs => TAll_of (map (fun b => (fst b, unopened (snd b))) bs)
    | TOne_of bs => TOne_of (map (fun b => (fst b, unopened (snd b))) bs)
    | TUntil k g a => TUntil k g (unopened a)
    | TDuring k d a => TDuring k d (unopened a)
    | TWatch a h => TWatch (unopened a) h
    | TRepeat n g a => TRepeat n g (unopened a)
    | TEnsure a ds => TEnsure (unopened a) ds
    | TKeys _ c _ => TFresh c
    end.

  Fixpoint build (p : supply) (ok : option (list vehicle)) (t : task) (k a b : nat) : residual :=
    match t with
    | TPlan x => Ready x (choice p k)
    | TAction c => Action c
    | TCondition g => Condition g
    | TSequence t t' =>
        sequence (build p ok t k a b) (build p ok t' (k + leaves t) (a + timers t) (b + places t))
    | TParallel t t' =>
        parallel [build p ok t k a b; build p ok t' (k + leaves t) (a + timers t) (b + places t)]
    | TAllocated t vs => build p (restrict ok vs) t k a b
    | TAll_of bs =>
        all_of ((fix branches (bs : list (code * task)) (k a b : nat) : list branch :=
                   match bs with
                   | [] => []
                   | (g, t) :: bs =>
                       (g, build p ok t k a b) :: branches bs (k + leaves t) (a + timers t) (b + places t)
                   end) bs k a b)
    | TOne_of bs =>
        One_of ((fix branches (bs : list (code * task)) (k a b : nat) : list branch :=
                   match bs with
                   | [] => []
                   | (g, t) :: bs =>
                       (g, build p ok t k a b) :: branches bs (k + leaves t) (a + timers t) (b + places t)
                   end) bs k a b)
    | TUntil c g t => Until c g (build p ok t k a b)
    | TIdle n => Idle (number p a b) n
    | TConfirm x s => Confirm (number p a b) x s
    | TDuring c (Seconds n) t => During c (number p a b) n (build p ok t k (S a) b)
    | TDuring c (Given_by d) t => During_code c (number p a b) d (build p ok t k (S a) b)
    | TWatch t h =>
        if may_recover h then
          Watch (build p ok t k a (S b))
            {| handles := h; anew := Some (unopened t, {| allowed := ok; place := spot p a b; depth := deep p |}) |}
        else Watch (build p ok t k a b) {| handles := h; anew := None |}
    | TRepeat n g t => let r := build p ok t k a b in repeat_ r (option_map pred n) g r
    | TKeys ks _ t => Fresh ks (build p ok t k a b)
    | TEnsure t ds => ensure_ (build p ok t k a b) ds
    (* No opened task has a fresh that is not. *)
    | TMade c | TFresh c => Made c [] {| allowed := ok; place := spot p a b; depth := deep p |}
    | TRecruit q c => Recruit (number p a b) q c (spot p (S a) b) (deep p)
    end.

  (** EXECUTE numbers keys, timers and places together, from 1. *)
  Definition next (a b : nat) : timer := N.of_nat (a + b + 1).
  Definition top (f : nat -> vehicle) : supply := {| choice := f; number := next; spot := next; deep := 0 |}.

  (** Timers of tasks that are made at place [i] have the numbers [i] + 1,000,000, [i] + 2,000,000 and so on, the first
      ones that are not used. [fresh i used n] is the [n]-th of them, from 0. *)
  Definition generation : N := 1000000.

  (** The first number after [i], in steps of a generation, that is not used; it is among the first [fuel]. *)
  Fixpoint after_ (used : list timer) (fuel : nat) (i : timer) : timer :=
    let j := (i + generation)%N in
    match fuel with
    | 0 => j
    | S fuel => if timer_mem j used then after_ used fuel j else j
    end.

  Fixpoint fresh (i : timer) (used : list timer) (n : nat) : timer :=
    match n with
    | 0 => after_ used (length used) i
    | S n => after_ used (length used) (fresh i used n)
    end.

  Definition made_at (q : request) (used : list timer) (f : nat -> vehicle) : supply :=
    {| choice := f; number := fun a _ => fresh (place q) used a; spot := fun _ _ => place q; deep := depth q |}.

  (** The task that code made: it only computed. *)
  Definition made_task (a : code) (ys : list value) (q : request) (S : shared) (x : value) (s : store) (ds : list deed)
    : option task :=
    if negb (takes a ys) then None
    else if deepest <=? depth q then None
    else match ds with
         | [] => if store_eq s (variables S) then task_of x else None
         | _ => None
         end.

  (** [open(t)] in a part that sees [h] as held, with the keys that [key] numbers; [q] is as deep as [t] is. Tasks that
      are made inside of it are deeper, so the [fuel] suffices. *)
  Fixpoint opened_with (fuel : nat) (w : world) (h : vehicle -> bool) (S : shared) (key : nat -> timer) (q : request)
      (t : task) (n : nat) : (task * nat) + message :=
    open_each (fun c n =>
      let ks := map key (seq n (parameters c)) in
      let ys := map key_value ks in
      let fails x := inr (no_opened_task c ys (depth q) (variables S) x) in
      match run c ys w h S with
      | Gives x s N ds =>
          match made_task c ys q S x s ds, fuel with
          | Some t, S fuel =>
              match opened_with fuel w h S key {| allowed := allowed q; place := place q; depth := 1 + depth q |}
                t (n + parameters c) with
              | inl (t, n) => inl (TKeys ks c t, n)
              | inr m => inr m
              end
          | _, _ => fails (Gives x s N ds)
          end
      | x => fails x
      end) t n.
  Definition opened := opened_with deepest.

  (** The code of the [fresh]s that stand in [t] runs alike in all tasks. *)
  Lemma opened_each w h S key q : exists inside, forall t n, opened w h S key q t n = open_each inside t n.
  Proof. unfold opened. destruct deepest; eexists; intros t n0; reflexivity. Qed.

  (** [alloc(open(t), B)], for EXECUTE. *)
  Definition alloc (w : world) (S : shared) (t : task) : residual + message :=
    match opened w (fun _ => false) S (fun n => next n 0) {| allowed := None; place := 0%N; depth := 0 |} t 0 with
    | inl (t, n) =>
        match assign w (bound S) None t with
        | inl f => inl (build (top f) None t 0 n 0)
        | inr m => inr m
        end
    | inr m => inr m
    end.

  (** The vehicles of B that [f] uses for [t], in pick order. *)
  Definition used_of (B : list vehicle) (t : task) (f : nat -> vehicle) : list vehicle :=
    List.filter (fun v => mem v (chosen t f 0)) (nodup vehicle_eq B).

  (** [alloc(open(t)[V], B)] for a task that is made at its turn, with the vehicles that it uses. *)
  Definition alloc_made (w : world) (h : vehicle -> bool) (S : shared) (B : list vehicle) (t : task) (q : request)
      (used : list timer) : (list vehicle * residual) + message :=
    match opened w h S (fresh (place q) used) q t 0 with
    | inl (t, n) =>
        match assign w B (allowed q) t with
        | inl f => inl (used_of B t f, build (made_at q used f) (allowed q) t 0 n 0)
        | inr m => inr m
        end
    | inr m => inr m
    end.
End Building.

Global Opaque opened.
