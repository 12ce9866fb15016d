(** Configurations, labels, events and effects. *)
From Dolphin Require Export Residuals.

Section Configurations.
  Context {L : Names}.

  (** {1 The shared part [S = <sigma, A, B, N>]} *)

  Record shared := {
    variables : store;                         (* sigma *)
    allocation : vehicle -> option plan;       (* A *)
    bound : list vehicle;                      (* B, in pick order *)
    space : tuples                             (* N *)
  }.

  Definition with_store (s : store) (S : shared) :=
    {| variables := s; allocation := allocation S; bound := bound S; space := space S |}.
  Definition with_code (s : store) (N : tuples) (S : shared) :=
    {| variables := s; allocation := allocation S; bound := bound S; space := N |}.
  Definition with_space (N : tuples) (S : shared) := with_code (variables S) N S.
  Definition with_bound (B : list vehicle) (S : shared) :=
    {| variables := variables S; allocation := allocation S; bound := B; space := space S |}.
  Definition with_allocation (A : vehicle -> option plan) (S : shared) :=
    {| variables := variables S; allocation := A; bound := bound S; space := space S |}.

  Definition nothing : vehicle -> option plan := fun _ => None.

  (** [S with A(v) = p], [S without A(vs)]. *)
  Definition start_on (v : vehicle) (p : plan) (S : shared) :=
    with_allocation (fun w => if vehicle_eq w v then Some p else allocation S w) S.
  Definition without (vs : list vehicle) (S : shared) :=
    with_allocation (fun w => if mem w vs then None else allocation S w) S.

  (** {1 Labels} *)

  Inductive deed :=
  | Posted (ks : list (key * value))
  | Consumed (ks : list (key * value))
  | Said (x : value)
  | Released (vs : list vehicle)
  | Timeout_set (vs : option (list vehicle)) (n : seconds).

  (** What a [pick] asks for: how many ([None]: all that fit), and whether it says what to do without. *)
  Record pick := { asked : filter; count : option nat; otherwise : bool }.

  Inductive label :=
  | LStart (v : vehicle) (p : plan)
  | LDone (v : vehicle) (p : plan)
  | LFail (v : vehicle) (p : plan) (m : message)
  | LCheck (ds : list deed)
  | LAct (ds : list deed)
  | LCut (ds : list deed)
  | LTimeout
  | LSet_time (n : seconds)
  | LMake
  | LAllocate (vs : list vehicle)
  | LCannot_execute (m : message)
  | LBroken (m : message)
  | LRecruit (v : vehicle)
  | LAnswered (yes : bool)
  | LNo_answer
  | LDid (d : deed)
  | LScript
  | LPick (q : pick)
  | LBind (vs : list vehicle)
  | LNo_vehicles (m : message)
  | LAsk (x : prompt)
  | LAnswer (text : prompt)
  | LPause (n : seconds)
  | LResume
  | LCall (c : host_call)
  | LReply (x : value)
  | LNo_reply (m : message)
  | LExecute
  | LEnd
  | LHalt (m : message)
  | LFault (m : message)
  | LInput (k : key) (x : value)
  | LInterrupt.

  (** {1 Configurations} *)

  Inductive ending := Completed | Halted (m : message) | Failed (m : message) | Interrupted.

  Inductive request_of_script :=
  | Pick (q : pick)
  | Ask (x : prompt)
  | Pause (n : seconds)
  | Call (c : host_call)
  | Execute (t : task).

  (** A script that waits to execute a task does not exist: EXECUTE and ALLOC-ERR are the script's own steps. *)
  Inductive waiting := For_pick (q : pick) | For_answer (x : prompt) | For_pause (n : seconds) | For_reply (c : host_call).

  Inductive control :=
  | Script (M : machine)
  | Wait (M : machine) (q : waiting)
  | Exec (M : machine) (r : residual)
  | End (e : ending).

  Record configuration := { control_of : control; shared_of : shared }.

  (** {1 Events and effects} *)

  Inductive event :=
  | Done (v : vehicle)
  | Failure (v : vehicle) (m : message)
  | Expired (i : timer)
  | Answered (i : timer) (yes : bool)
  | Nobody_answers (i : timer) (m : message)
  | Comes (i : timer) (v : vehicle)                      (* recruited i v *)
  | Text (text : prompt)                                 (* answered text: by ask *)
  | No_text (m : message)                                (* nobody answers m *)
  | Replied (x : value)
  | Host_failed (m : message)
  | Input (k : key) (x : value)
  | Interruption.

  Inductive effect :=
  | Start (p : plan) (v : vehicle)
  | Stop (v : vehicle)
  | Set_timer (i : timer) (n : seconds)
  | Cancel_timer (i : timer)
  | Put_question (i : timer) (x : prompt)
  | Withdraw_question (i : timer)
  | Look_for (q : pick)
  | Bind (vs : list vehicle)
  | Release (vs : list vehicle)
  | Set_connection_timeout (vs : option (list vehicle)) (n : seconds)
  | Say (x : value)
  | Ask_ (x : prompt)
  | Call_ (c : host_call)
  | End_ (e : ending).

  Definition begins (w : timer * wait) : effect :=
    match w with (i, Time n) => Set_timer i n | (i, Answer_to x) => Put_question i x end.
  Definition ceases (w : timer * wait) : effect :=
    match w with (i, Time _) => Cancel_timer i | (i, Answer_to _) => Withdraw_question i end.

  (** What begins by activation of [r]. *)
  Definition begun (r : residual) : list effect := map begins (waits r).

  Definition release (vs : list vehicle) : list effect := match vs with [] => [] | _ => [Release vs] end.

  (** [cut(r)], for what stands side by side. *)
  Definition cut (rs : list residual) : list effect :=
    map ceases (flat_map waits rs) ++ map Stop (flat_map run_of rs) ++ release (flat_map recruits rs).

  Definition effect_of (d : deed) : list effect :=
    match d with
    | Posted _ | Consumed _ => []
    | Said x => [Say x]
    | Released vs => [Release vs]
    | Timeout_set vs n => [Set_connection_timeout vs n]
    end.
  Definition effects_of (ds : list deed) : list effect := flat_map effect_of ds.

  Definition is_said (d : deed) : bool := match d with Said _ => true | _ => false end.

  (** Of the deeds of faulty code, what it said. *)
  Definition said (ds : list deed) : list deed := List.filter is_said ds.

  (** The pairs that a guard took, and their values. *)
  Definition taken_pairs (ds : list deed) : list (key * value) :=
    flat_map (fun d => match d with Consumed ks => ks | _ => [] end) ds.
  Definition taken (ds : list deed) : list value := map snd (taken_pairs ds).
End Configurations.
