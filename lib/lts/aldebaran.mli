(** Aldebaran's format, [.aut], which CADP, mCRL2 and LTSmin read and write.

    {v
des (0, 2, 3)
(0,"start(survey1)",1)
(1,"done(survey1)",2)
    v}

    The first line has the initial state, the number of transitions and that of states. mCRL2 ends a label at the
    first double quote, and CADP allows ASCII only. So what is written is printable ASCII without double quotes: any
    other byte is [\x] and two hexadecimal digits in lower case, and so is a backslash that would read as such an
    escape. A double quote is [\x22]; a label of printable ASCII without double quotes stands as it is.

    {[
      open Dolphin_lts

      let () =
        let graph = Graph.of_list [ (0, "start(survey1)", 1); (1, "done(survey1)", 2) ] in
        let text = Aldebaran.to_string graph in
        assert (text = "des (0, 2, 3)\n(0,\"start(survey1)\",1)\n(1,\"done(survey1)\",2)\n");
        assert (Graph.equal graph (Result.get_ok (Aldebaran.of_string text)))
    ]} *)

val write : (string -> unit) -> Graph.t -> unit
(** [write out g] calls [out] with the parts of the text of [g], in order: [write (output_string channel) g]. Texts of
    states are left out. *)

val to_string : Graph.t -> string
(** The text that {!write} writes. *)

(** {1:read To read} *)

(** Labels, states and numbers as they stand in the file. *)
type problem =
  | Not_a_header of string  (** the first line is not [des (...)] *)
  | Not_a_transition of string
  | Unclosed_label of string
  | No_states  (** the header declares an empty graph *)
  | Number_too_large of string
  | No_such_state of { state : int; states : int }
  | Wrong_count of { announced : int; found : int }  (** of transitions *)

type error = { line : int; problem : problem }
(** [line] counts from 1; of {!Wrong_count} it is the header's. *)

val of_string : string -> (Graph.t, error) result
(** [of_string (to_string g)] equals [g], but for the texts of states. Blanks around words, carriage returns and empty
    lines do not matter. A label may also stand without quotes, and a quoted one may contain quotes, commas, parentheses
    and UTF-8: it ends at the last quote of the line. Escapes, as above, are undone. *)

val pp_error : Format.formatter -> error -> unit
(** The fault and its line, without a full stop. *)
