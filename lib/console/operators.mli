(** The people who may use a console of other machines, by the file of [--operators]:

    {v
    # name   role     token, at least 16 letters, digits, dashes and underscores
    ana      steer
    rui      answer,pilot   pK2v_0Zs81mWq4tL
    v}

    Without a token one is made at each start. The words after the role are duties: questions whose prompt begins with
    such a word and a colon, [confirm 'pilot: May it dive?'], are for the operators who have it. *)

(** [Answers]: sees all, answers questions and posts inputs, with or without the helm; commands nothing else. *)
type role = Watches | Answers | Steers

(** [name] is [None] for the two links of a console without such a file. *)
type operator = {
  name : string option;
  role : role;
  admin : bool;  (** answers every question, and may shut others out; the role is [Steers] *)
  duties : string list;
  token : string;
}

val anonymous : unit -> operator list
(** One that steers and one that watches, with new tokens of 128 bits. *)

val secret : unit -> string
(** 128 random bits, in hexadecimal digits. *)

val read : string -> (operator list, string) result
(** [read text] is the operators of a file with this text. The error names the line. *)

val load : string -> (operator list, Dolphin_app.Error.t) result
(** [load path] is {!read} of the file [path], which only its owner may read or write. *)

val role_word : operator -> string
(** As files and journals have it: [watch], [answer], [steer], [admin]. *)

val role_name : role -> string
(** [watches], [answers], [steers]. *)

val addressee : operator list -> string -> string option
(** [addressee operators prompt] is the text before the first colon of [prompt], if it is the name or a duty of one of
    [operators]. Otherwise the question is for everybody. *)

val may_answer : operator list -> operator -> string -> bool
(** [may_answer operators o prompt] is whether the question is for everybody, or [o] has the name or duty that it is
    addressed to, or is an admin. The role is not looked at. *)
