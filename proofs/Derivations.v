(** The names of the rules that give a transition, from the axiom outwards, as `dolphin step` has them. *)
From Coq Require Import String.
From Dolphin Require Export Script.

Section Derivations.
  Context {L : Names} {C : Code}.

  Local Open Scope string_scope.

  (** The rule of a node's own step: its kind and what it comes to tell which. *)
  Definition own_rule (r : residual) (t : transition) : string :=
    match t with
    | By _ _ (Ends (Halted _)) _ => "HALT"
    | By _ _ (Ends _) _ => "ASSERT-ERR"
    | By l _ o _ =>
        let or_error (name error : string) := match o with Err _ => error | _ => name end in
        match r with
        | Ready _ _ => "START"
        | Running _ _ => or_error "DONE" "FAIL"
        | Action _ => or_error "ACTION" "ACTION-ERR"
        | Condition _ => or_error "CONDITION" "CONDITION-ERR"
        | All_of _ => or_error "ALLOF-WHEN" "ALLOF-ERR"
        | One_of _ => or_error "ONEOF-WHEN" "ONEOF-ERR"
        | Until k _ _ =>
            match l, k with LBroken _, _ => "UNTIL-ERR" | _, Completes => "UNTIL-CUT" | _, Fails _ => "ASSURE-CUT" end
        | Idle _ _ => "IDLE-END"
        | Confirm _ _ _ => or_error "CONFIRM-YES" "CONFIRM-NO"
        | During _ _ _ _ => or_error "DURING-CUT" "WITHIN-CUT"
        | During_code _ _ _ _ => or_error "DURING-SET" "DURING-ERR"
        | Asked _ _ _ => match o with Ok => "REPEAT-UNTIL" | Err _ => "REPEAT-ERR" | _ => "REPEAT-AGAIN" end
        | Made _ _ _ => or_error "MAKE" "MAKE-ERR"
        | Unallocated _ _ => or_error "ALLOCATE" "ALLOCATE-ERR"
        | Recruit _ _ _ _ _ => "RECRUIT"
        | Sequence _ _ | Parallel _ | Branch _ _ | Watch _ _ | Repeat _ _ _ _ | Holding _ _ | Recruited _ _
        | Fresh _ _ | Ensure _ _ => ""
        end
    end.

  (** The rule by which a step of a part is one of the frame around it; the end of the program needs none. *)
  Definition frame_rule (f : frame) (t t' : transition) : list string :=
    let by_outcome (next ok error : string) :=
      match t with
      | By _ _ (Next _) _ => [next]
      | By _ _ Ok _ => [ok]
      | By _ _ (Err _) _ => [error]
      | By _ _ (Ends _) _ => []
      end in
    match f with
    | In_sequence _ => by_outcome "SEQ-1" "SEQ-2" "SEQ-ERR"
    | Beside _ _ => by_outcome "PAR-1" "PAR-2" "PAR-ERR"
    | Branch_of _ => by_outcome "ALLOF-1" "ALLOF-2" "ALLOF-ERR"
    | Body_until _ _ => by_outcome "UNTIL-1" "UNTIL-2" "UNTIL-ERR"
    | Body_during _ _ _ => by_outcome "DURING-1" "DURING-2" "DURING-ERR"
    | Round_of _ _ _ => by_outcome "REPEAT-1" "REPEAT-2" "REPEAT-ERR"
    | Held_by _ => by_outcome "HOLD-1" "HOLD-2" "HOLD-ERR"
    | In_recruited _ => by_outcome "RECRUIT-1" "RECRUIT-2" "RECRUIT-ERR"
    | With_keys _ => by_outcome "FRESH-1" "FRESH-2" "FRESH-ERR"
    | Ensuring _ => by_outcome "ENSURE-1" "ENSURE-2" "ENSURE-ERR"
    | In_watch _ =>
        by_outcome "WATCH-1" "WATCH-2"
          match t' with
          | By _ _ Ok _ => "WATCH-IGNORE"
          | By _ _ (Next (Watch _ _)) _ => "WATCH-RETRY"
          | By _ _ (Next _) _ => "WATCH-INSTEAD"
          | By _ _ (Err _) _ => "WATCH-PROPAGATE"
          | By _ _ (Ends (Halted _)) _ => "WATCH-HALT"
          | By _ _ (Ends _) _ => "ASSERT-ERR"
          end
    end.

  Notation derived := (transition * list string)%type.

  Definition lift_derived (f : frame) (K : context) (d : derived) : list derived :=
    map (fun t' => (t', snd d ++ frame_rule f (fst d) t')%list) (lift f K (fst d)).

  (** [steps], each with its derivation. *)
  Definition derivations (e : option event) (r : residual) (K : context) (S : shared) : list derived :=
    walk (fun K r => map (fun t => (t, [own_rule r t])) (own e K S r)) lift_derived r K.

  Lemma map_lift f K ds : map fst (flat_map (lift_derived f K) ds) = flat_map (lift f K) (map fst ds).
  Proof.
    induction ds as [|d ds IH]; [reflexivity|]. cbn [flat_map map]. rewrite map_app, IH. f_equal.
    unfold lift_derived. rewrite map_map. apply map_id.
  Qed.

  (** Derivations change no step. *)
  Theorem derivations_are_steps e r K S : map fst (derivations e r K S) = steps e r K S.
  Proof.
    unfold derivations, steps. revert K.
    induction r using residual_rect'; intros K; cbn [walk]; rewrite map_app, map_map; cbn [fst];
      rewrite map_id; f_equal; try reflexivity; try (rewrite map_lift, IHr; reflexivity);
      try (rewrite map_lift, IHr1; reflexivity).
    match goal with |- map fst (?f [] ?rs) = ?g [] ?rs =>
      enough (G : forall before, map fst (f before rs) = g before rs) by apply G
    end.
    induction H as [|r rs Hr _ IH]; intros before; [reflexivity|].
    rewrite map_app, map_lift, Hr, IH. reflexivity.
  Qed.

  (** {1 Of configurations} *)

  Definition script_rule (t : ctransition) : string :=
    match t with
    | To l c _ =>
        match l with
        | LScript => "SCRIPT"
        | LDid (Posted _) => "POST"
        | LDid (Consumed _) => "CONSUME"
        | LDid (Said _) => "MESSAGE"
        | LDid (Released _) => "RELEASE"
        | LDid (Timeout_set _ _) => "SET-TIMEOUT"
        | LPick _ => "PICK"
        | LBind _ => "PICK-BIND"
        | LNo_vehicles _ => match control_of c with End _ => "PICK-ERR" | _ => "PICK-ELSE" end
        | LAsk _ => "ASK"
        | LAnswer _ => "ANSWER"
        | LNo_answer => "ANSWER-ERR"
        | LPause _ => "PAUSE"
        | LResume => "RESUME"
        | LCall _ => "CALL"
        | LReply _ => "REPLY"
        | LNo_reply _ => "CALL-ERR"
        | LExecute => "EXECUTE"
        | LCannot_execute _ => "ALLOC-ERR"
        | LEnd => "END"
        | LHalt _ => "HALT"
        | LFault _ => "FAULT"
        | LInput _ _ => "INPUT"
        | LInterrupt => match control_of c with End _ => "INTERRUPT" | _ => "ON-INTERRUPT" end
        | _ => ""
        end
    end.

  Definition conclude_derived (x : option event) (M : machine) (r : residual) (d : derived)
    : (ctransition * list string) :=
    (conclude x M r (fst d),
     snd d ++ match fst d with By _ _ Ok _ => ["EXECUTE-DONE"] | By _ _ (Err _) _ => ["EXECUTE-ERR"] | _ => [] end)%list.

  (** [csteps], each with its derivation. *)
  Definition cderivations (w : world) (x : option event) (c : configuration) : list (ctransition * list string) :=
    match control_of c, x with
    | Exec M r, Some (Input _ _) | Exec M r, Some Interruption => map (fun t => (t, [script_rule t])) (csteps w x c)
    | Exec M r, x => map (conclude_derived x M r) (derivations x r (alone w) (shared_of c))
    | _, x => map (fun t => (t, [script_rule t])) (csteps w x c)
    end.

  Theorem cderivations_are_csteps w x c : map fst (cderivations w x c) = csteps w x c.
  Proof.
    assert (Named : forall ts, map fst (map (fun t : ctransition => (t, [script_rule t])) ts) = ts).
    { intros ts. rewrite map_map. apply map_id. }
    assert (Task : forall M r, map fst (map (conclude_derived x M r) (derivations x r (alone w) (shared_of c))) =
                               map (conclude x M r) (steps x r (alone w) (shared_of c))).
    { intros M r. rewrite <- derivations_are_steps, !map_map. reflexivity. }
    unfold cderivations. destruct (control_of c) as [M | M q | M r | y] eqn:Hc; try (apply Named).
    unfold csteps. rewrite Hc.
    destruct x as [[]|]; try (apply Task);
      change (map fst (map (fun t : ctransition => (t, [script_rule t])) (csteps w (Some (Input k x)) c)) =
              csteps w (Some (Input k x)) c)
      || apply Named.
  Qed.
End Derivations.
