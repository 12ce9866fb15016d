(** Residuals: what is left of a task that executes. *)
From Dolphin Require Export Syntax.

Section Residuals.
  Context {L : Names}.

  (** What a task without vehicles is to be allocated with: for which vehicles, in the numbers of which place, and how
      deep it is in tasks that closures made. *)
  Record request := { allowed : option (list vehicle); place : timer; depth : nat }.

  (** A handler; if it may recover, with the task that it watches. *)
  Record handler := { handles : code; anew : option (task * request) }.

  Inductive residual :=
  | Ready (p : plan) (v : vehicle)                                   (* p@v *)
  | Running (p : plan) (v : vehicle)                                 (* p@v... *)
  | Action (a : code)
  | Condition (g : code)
  | Sequence (r t : residual)                                        (* r >> t *)
  | Parallel (rs : list residual)                                    (* r1 | ... | rn *)
  | Branch (r : residual) (bs : list (code * residual))              (* allOf(r; bs) *)
  | All_of (bs : list (code * residual))
  | One_of (bs : list (code * residual))
  | Until (k : on_cut) (g : code) (r : residual)                     (* until g r, assure g r *)
  | Idle (i : timer) (n : seconds)
  | Confirm (i : timer) (x : prompt) (at_site : site)
  | During (k : on_cut) (i : timer) (n : seconds) (r : residual)     (* during i n r, within i n r *)
  | During_code (k : on_cut) (i : timer) (d : code) (r : residual)   (* during i d r, within i d r *)
  | Watch (r : residual) (h : handler)
  | Repeat (r : residual) (more : option nat) (g : option code) (t : residual)  (* repeat(r; q) *)
  | Asked (more : option nat) (g : code) (t : residual)              (* repeat(q) *)
  | Made (a : code) (ys : list value) (q : request)
  | Unallocated (t : task) (q : request)
  | Holding (vs : list vehicle) (r : residual)
  | Recruit (i : timer) (q : filter) (a : code) (j : timer) (deep : nat)
  | Recruited (v : vehicle) (r : residual)
  | Fresh (ks : list timer) (r : residual)                           (* r has the keys of these numbers *)
  | Ensure (r : residual) (ds : list end_deed).                      (* r, and the deeds of its end *)

  Definition branch := (code * residual)%type.

  (** Induction that goes into lists of parts. *)
  Section Induction.
    Variable P : residual -> Prop.
    Hypothesis on_ready : forall p v, P (Ready p v).
    Hypothesis on_running : forall p v, P (Running p v).
    Hypothesis on_action : forall a, P (Action a).
    Hypothesis on_condition : forall g, P (Condition g).
    Hypothesis on_sequence : forall r t, P r -> P t -> P (Sequence r t).
    Hypothesis on_parallel : forall rs, Forall P rs -> P (Parallel rs).
    Hypothesis on_branch : forall r bs, P r -> Forall (fun b => P (snd b)) bs -> P (Branch r bs).
    Hypothesis on_all_of : forall bs, Forall (fun b => P (snd b)) bs -> P (All_of bs).
    Hypothesis on_one_of : forall bs, Forall (fun b => P (snd b)) bs -> P (One_of bs).
    Hypothesis on_until : forall k g r, P r -> P (Until k g r).
    Hypothesis on_idle : forall i n, P (Idle i n).
    Hypothesis on_confirm : forall i x s, P (Confirm i x s).
    Hypothesis on_during : forall k i n r, P r -> P (During k i n r).
    Hypothesis on_during_code : forall k i d r, P r -> P (During_code k i d r).
    Hypothesis on_watch : forall r h, P r -> P (Watch r h).
    Hypothesis on_repeat : forall r n g t, P r -> P t -> P (Repeat r n g t).
    Hypothesis on_asked : forall n g t, P t -> P (Asked n g t).
    Hypothesis on_made : forall a ys q, P (Made a ys q).
    Hypothesis on_unallocated : forall t q, P (Unallocated t q).
    Hypothesis on_holding : forall vs r, P r -> P (Holding vs r).
    Hypothesis on_recruit : forall i q a j d, P (Recruit i q a j d).
    Hypothesis on_recruited : forall v r, P r -> P (Recruited v r).
    Hypothesis on_fresh : forall ks r, P r -> P (Fresh ks r).
    Hypothesis on_ensure : forall r ds, P r -> P (Ensure r ds).

    Fixpoint residual_rect' (r : residual) : P r :=
      let fix all (rs : list residual) : Forall P rs :=
        match rs with [] => Forall_nil _ | r :: rs => Forall_cons _ (residual_rect' r) (all rs) end in
      let fix branches (bs : list branch) : Forall (fun b => P (snd b)) bs :=
        match bs with
        | [] => Forall_nil _
        | (g, r) as b :: bs => Forall_cons (P := fun b => P (snd b)) (g, r) (residual_rect' r) (branches bs)
        end in
      match r with
      | Ready p v => on_ready p v
      | Running p v => on_running p v
      | Action a => on_action a
      | Condition g => on_condition g
      | Sequence r t => on_sequence r t (residual_rect' r) (residual_rect' t)
      | Parallel rs => on_parallel rs (all rs)
      | Branch r bs => on_branch r bs (residual_rect' r) (branches bs)
      | All_of bs => on_all_of bs (branches bs)
      | One_of bs => on_one_of bs (branches bs)
      | Until k g r => on_until k g r (residual_rect' r)
      | Idle i n => on_idle i n
      | Confirm i x s => on_confirm i x s
      | During k i n r => on_during k i n r (residual_rect' r)
      | During_code k i d r => on_during_code k i d r (residual_rect' r)
      | Watch r h => on_watch r h (residual_rect' r)
      | Repeat r n g t => on_repeat r n g t (residual_rect' r) (residual_rect' t)
      | Asked n g t => on_asked n g t (residual_rect' t)
      | Made a ys q => on_made a ys q
      | Unallocated t q => on_unallocated t q
      | Holding vs r => on_holding vs r (residual_rect' r)
      | Recruit i q a j d => on_recruit i q a j d
      | Recruited v r => on_recruited v r (residual_rect' r)
      | Fresh ks r => on_fresh ks r (residual_rect' r)
      | Ensure r ds => on_ensure r ds (residual_rect' r)
      end.
  End Induction.

  (** {1 Normal forms} *)

  Fixpoint sequence (r t : residual) : residual :=
    match r with
    | Sequence a b => Sequence a (sequence b t)
    | _ => Sequence r t
    end.

  Definition flat (r : residual) : list residual := match r with Parallel rs => rs | r => [r] end.

  Definition parallel (rs : list residual) : residual :=
    match flat_map flat rs with [r] => r | rs => Parallel rs end.

  Definition all_of (bs : list branch) : residual := match bs with [b] => One_of [b] | bs => All_of bs end.

  Definition branch_of (r : residual) (bs : list branch) : residual :=
    match bs with [] => r | bs => Branch r bs end.

  (** [repeat_ r q] with [more] rounds to come after [r]; of an endless number one less is endless. *)
  Definition repeat_ (r : residual) (more : option nat) (g : option code) (t : residual) : residual :=
    match more with Some 0 => r | _ => Repeat r more g t end.

  Definition holding (vs : list vehicle) (r : residual) : residual := match vs with [] => r | _ => Holding vs r end.

  Definition ensure_ (r : residual) (ds : list end_deed) : residual := match ds with [] => r | _ => Ensure r ds end.

  (** {1 Activation}

      What waits for the outside in a part: a timer that runs, or a question that stands. Activation starts them, so the
      residual does not change; [waits] lists them both before and after. *)

  Inductive wait := Time (n : seconds) | Answer_to (x : prompt).

  Fixpoint waits (r : residual) : list (timer * wait) :=
    match r with
    | Idle i n => [(i, Time n)]
    | Confirm i x _ => [(i, Answer_to x)]
    | During _ i n r => (i, Time n) :: waits r
    | Parallel rs => flat_map waits rs
    | Sequence r _ | Branch r _ | Until _ _ r | Watch r _ | Repeat r _ _ _ | Holding _ r | Recruited _ r | Fresh _ r
    | Ensure r _ => waits r
    | Ready _ _ | Running _ _ | Action _ | Condition _ | All_of _ | One_of _ | During_code _ _ _ _ | Asked _ _ _
    | Made _ _ _ | Unallocated _ _ | Recruit _ _ _ _ _ => []
    end.

  (** The keys of what is active: N has none of their pairs when it begins. *)
  Fixpoint keys (r : residual) : list timer :=
    match r with
    | Fresh ks r => ks ++ keys r
    | Parallel rs => flat_map keys rs
    | Sequence r _ | Branch r _ | Until _ _ r | During _ _ _ r | Watch r _ | Repeat r _ _ _ | Holding _ r
    | Recruited _ r | Ensure r _ => keys r
    | Ready _ _ | Running _ _ | Action _ | Condition _ | All_of _ | One_of _ | Idle _ _ | Confirm _ _ _
    | During_code _ _ _ _ | Asked _ _ _ | Made _ _ _ | Unallocated _ _ | Recruit _ _ _ _ _ => []
    end.

  (** {1 What is active} *)

  (** The vehicles that run a task, with the task: [run(r)]. *)
  Fixpoint running (r : residual) : list (vehicle * plan) :=
    match r with
    | Running p v => [(v, p)]
    | Parallel rs => flat_map running rs
    | Sequence r _ | Branch r _ | Until _ _ r | During _ _ _ r | Watch r _ | Repeat r _ _ _ | Holding _ r
    | Recruited _ r | Fresh _ r | Ensure r _ => running r
    | Ready _ _ | Action _ | Condition _ | All_of _ | One_of _ | Idle _ _ | Confirm _ _ _ | During_code _ _ _ _
    | Asked _ _ _ | Made _ _ _ | Unallocated _ _ | Recruit _ _ _ _ _ => []
    end.

  Definition run_of (r : residual) : list vehicle := map fst (running r).

  (** The vehicles [v] of each active [recruited v]. *)
  Fixpoint recruits (r : residual) : list vehicle :=
    match r with
    | Recruited v r => v :: recruits r
    | Parallel rs => flat_map recruits rs
    | Sequence r _ | Branch r _ | Until _ _ r | During _ _ _ r | Watch r _ | Repeat r _ _ _ | Holding _ r | Fresh _ r
    | Ensure r _ => recruits r
    | Ready _ _ | Running _ _ | Action _ | Condition _ | All_of _ | One_of _ | Idle _ _ | Confirm _ _ _
    | During_code _ _ _ _ | Asked _ _ _ | Made _ _ _ | Unallocated _ _ | Recruit _ _ _ _ _ => []
    end.

  (** [ensured(r)]: the deeds of the ends of what is active, inner ones first. *)
  Fixpoint ensured (r : residual) : list end_deed :=
    match r with
    | Ensure r ds => ensured r ++ ds
    | Parallel rs => flat_map ensured rs
    | Sequence r _ | Branch r _ | Until _ _ r | During _ _ _ r | Watch r _ | Repeat r _ _ _ | Holding _ r
    | Recruited _ r | Fresh _ r => ensured r
    | Ready _ _ | Running _ _ | Action _ | Condition _ | All_of _ | One_of _ | Idle _ _ | Confirm _ _ _
    | During_code _ _ _ _ | Asked _ _ _ | Made _ _ _ | Unallocated _ _ | Recruit _ _ _ _ _ => []
    end.

  (** {1 What is named} *)

  Fixpoint names (r : residual) : list vehicle :=
    match r with
    | Ready _ v | Running _ v => [v]
    | Recruited v r => v :: names r
    | Holding vs r => vs ++ names r
    | Sequence r t | Repeat r _ _ t => names r ++ names t
    | Parallel rs => flat_map names rs
    | Branch r bs => names r ++ flat_map (fun b => names (snd b)) bs
    | All_of bs | One_of bs => flat_map (fun b => names (snd b)) bs
    | Until _ _ r | During _ _ _ r | During_code _ _ _ r | Watch r _ | Asked _ _ r | Fresh _ r | Ensure r _ => names r
    | Action _ | Condition _ | Idle _ _ | Confirm _ _ _ | Made _ _ _ | Unallocated _ _ | Recruit _ _ _ _ _ => []
    end.

  (** The numbers of timers, questions, recruits and keys, also of parts to come. *)
  Fixpoint numbers (r : residual) : list timer :=
    match r with
    | Idle i _ | Confirm i _ _ | Recruit i _ _ _ _ => [i]
    | During _ i _ r | During_code _ i _ r => i :: numbers r
    | Fresh ks r => ks ++ numbers r
    | Sequence r t | Repeat r _ _ t => numbers r ++ numbers t
    | Parallel rs => flat_map numbers rs
    | Branch r bs => numbers r ++ flat_map (fun b => numbers (snd b)) bs
    | All_of bs | One_of bs => flat_map (fun b => numbers (snd b)) bs
    | Until _ _ r | Watch r _ | Asked _ _ r | Holding _ r | Recruited _ r | Ensure r _ => numbers r
    | Ready _ _ | Running _ _ | Action _ | Condition _ | Made _ _ _ | Unallocated _ _ => []
    end.

  (** {1 Contexts} *)

  (** What is around a part that may go on. *)
  Inductive frame :=
  | In_sequence (t : residual)
  | Beside (before after : list residual)
  | Branch_of (bs : list branch)
  | Body_until (k : on_cut) (g : code)
  | Body_during (k : on_cut) (i : timer) (n : seconds)
  | In_watch (h : handler)
  | Round_of (more : option nat) (g : option code) (t : residual)
  | Held_by (vs : list vehicle)
  | In_recruited (v : vehicle)
  | With_keys (ks : list timer)
  | Ensuring (ds : list end_deed).

  Definition plug (f : frame) (r : residual) : residual :=
    match f with
    | In_sequence t => Sequence r t
    | Beside before after => Parallel (before ++ r :: after)
    | Branch_of bs => Branch r bs
    | Body_until k g => Until k g r
    | Body_during k i n => During k i n r
    | In_watch h => Watch r h
    | Round_of more g t => Repeat r more g t
    | Held_by vs => Holding vs r
    | In_recruited v => Recruited v r
    | With_keys ks => Fresh ks r
    | Ensuring ds => Ensure r ds
    end.

  Definition frame_names (f : frame) : list vehicle :=
    match f with
    | In_sequence t | Round_of _ _ t => names t
    | Beside before after => flat_map names (before ++ after)
    | Branch_of bs => flat_map (fun b => names (snd b)) bs
    | Held_by vs => vs
    | In_recruited v => [v]
    | Body_until _ _ | Body_during _ _ _ | In_watch _ | With_keys _ | Ensuring _ => []
    end.

  Definition frame_numbers (f : frame) : list timer :=
    match f with
    | In_sequence t | Round_of _ _ t => numbers t
    | Beside before after => flat_map numbers (before ++ after)
    | Branch_of bs => flat_map (fun b => numbers (snd b)) bs
    | Body_during _ i _ => [i]
    | With_keys ks => ks
    | Held_by _ | In_recruited _ | Body_until _ _ | In_watch _ | Ensuring _ => []
    end.
End Residuals.
