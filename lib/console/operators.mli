(** The people who may use a console of other machines, by the file of [--operators]:

    {v
    # name   role     token, at least 16 letters, digits, dashes and underscores
    ana      steer
    rui      answer   pK2v_0Zs81mWq4tL
    v}

    Without a token one is made at each start. *)

(** [Answers]: sees all, answers questions and posts inputs, with or without the helm; commands nothing else. *)
type role = Watches | Answers | Steers

type operator = { name : string option; role : role; token : string }
(** [name] is [None] for the two links of a console without such a file. *)

val anonymous : unit -> operator list
(** One that steers and one that watches, with new tokens of 128 bits. *)

val secret : unit -> string
(** 128 random bits, in hexadecimal digits. *)

val read : string -> (operator list, string) result
(** [read text] is the operators of a file with this text. The error names the line. *)

val load : string -> (operator list, Dolphin_app.Error.t) result
(** [load path] is {!read} of the file [path], which only its owner may read or write. *)

val role_word : role -> string
(** As files and journals have it: [watch], [answer], [steer]. *)

val role_name : role -> string
(** [watches], [answers], [steers]. *)
