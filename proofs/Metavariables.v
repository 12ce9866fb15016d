(** Metavariables of docs/semantics.md. What the rules only pass on is a parameter: vehicles, plans, code, values, times
    and messages. Every theorem holds for all of them. *)
From Coq Require Export List Bool Arith NArith Lia.
Export ListNotations.
Set Implicit Arguments.

Class Names := {
  vehicle : Type;                                   (* v *)
  vehicle_eq : forall v w : vehicle, {v = w} + {v <> w};
  plan : Type;                                      (* p *)
  code : Type;                                      (* g, a, h, d: closures *)
  value : Type;                                     (* x *)
  key : Type;                                       (* k *)
  seconds : Type;                                   (* n *)
  prompt : Type;                                    (* the text of a question *)
  message : Type;                                   (* m: with its place, and the vehicle and task that failed *)
  site : Type;                                      (* a place in the program *)
  filter : Type;                                    (* q: what a vehicle must be or have *)
  store : Type;                                     (* sigma *)
  store_eq : forall s s' : store, {s = s'} + {s <> s'};
  tuples : Type;                                    (* N *)
  world : Type;                                     (* w *)
  machine : Type;                                   (* M *)
  host_call : Type;                                 (* a call of the host *)
  assignment : Type                                 (* v = x: a global variable with its value *)
}.

(** A timer, a question or a recruit, by its place in the executed task, from 1; 0 is the script's timer. *)
Definition timer := N.
Definition script_timer : timer := 0%N.
Definition timer_eq : forall i j : timer, {i = j} + {i <> j} := N.eq_dec.

Section Sets.
  Context {L : Names}.

  (** [mem v vs] is whether [v] is one of [vs]. *)
  Definition mem (v : vehicle) (vs : list vehicle) : bool := if in_dec vehicle_eq v vs then true else false.

  Lemma mem_spec v vs : mem v vs = true <-> In v vs.
  Proof. unfold mem. destruct (in_dec vehicle_eq v vs); split; intros; auto; discriminate. Qed.

  Lemma mem_false v vs : mem v vs = false <-> ~ In v vs.
  Proof. rewrite <- mem_spec. destruct (mem v vs); split; intros; auto; [discriminate | congruence]. Qed.

  Definition timer_mem (i : timer) (is : list timer) : bool := if in_dec timer_eq i is then true else false.

  Lemma timer_mem_spec i is : timer_mem i is = true <-> In i is.
  Proof. unfold timer_mem. destruct (in_dec timer_eq i is); split; intros; auto; discriminate. Qed.

  (** The members of [vs] that are not in [ws]: [vs - ws], in the order of [vs]. *)
  Definition minus (vs ws : list vehicle) : list vehicle := List.filter (fun v => negb (mem v ws)) vs.
  Definition both (vs ws : list vehicle) : list vehicle := List.filter (fun v => mem v ws) vs.

  Lemma in_minus v vs ws : In v (minus vs ws) <-> In v vs /\ ~ In v ws.
  Proof. unfold minus. rewrite filter_In, negb_true_iff, mem_false. tauto. Qed.

  Lemma in_both v vs ws : In v (both vs ws) <-> In v vs /\ In v ws.
  Proof. unfold both. rewrite filter_In, mem_spec. tauto. Qed.
End Sets.
