(** JSON formats, each described once: a codec reads JSON, writes it, and has its JSON Schema (2020-12).

    {[
      open Dolphin_json

      type vehicle = { name : string; speed : float; payload : string list }

      let vehicle =
        let open Codec in
        record
          (let+ name = field "name" word (fun v -> v.name)
           and+ speed = default 1.5 "speed" (number ~least:0. ()) (fun v -> v.speed)
           and+ payload = default [] "payload" (list text) (fun v -> v.payload) in
           { name; speed; payload })

      let () =
        let read text = Codec.read (Codec.list vehicle) (Yojson.Safe.from_string text) in
        assert (read {|[{"name": "x8-02"}]|} = Ok [ { name = "x8-02"; speed = 1.5; payload = [] } ]);
        assert (read {|[{"name": "x8-02", "speed": -1}]|} = Error {|"[0].speed" is -1, not a number from 0|});
        assert (
          Canonical.to_string (Codec.write vehicle { name = "a"; speed = 2.; payload = [] })
          = {|{"name":"a","speed":2}|})
    ]} *)

type json = Yojson.Safe.t
(** JSON. *)

type 'a t
(** How values of type ['a] are read and written. *)

val read : 'a t -> json -> ('a, string) result
(** [read codec json] is the value of [json]. The error has the path of the place that is wrong, and why:
    [{|"items[2].name" is missing|}]; without a path if that is [json] itself. *)

val write : 'a t -> 'a -> json
(** [write codec x] is the JSON of [x]: [read codec (write codec x) = Ok x]. *)

val to_string : 'a t -> 'a -> string
(** [to_string codec x] is [write codec x] by {!Canonical.to_string}. *)

val schema : title:string -> 'a t -> json
(** [schema ~title codec] is the JSON Schema of [codec], with its {!named} definitions in [$defs]. All written values
    are valid. All valid values are read, except for those that {!conv} refuses. *)

(** {1:values Values} *)

val text : string t
(** A text. *)

val word : string t
(** A text that is not empty. *)

val text_up_to : int -> string t
(** [text_up_to n] is {!word}, of at most [n] bytes. *)

val truth : bool t
(** [true] or [false]. *)

val whole : ?least:int -> ?most:int -> unit -> int t
(** Numbers written without a fraction, from [least] to [most]. *)

val count : int t
(** A whole number, at least 0. *)

val number : ?least:float -> ?most:float -> unit -> float t
(** Finite numbers from [least] to [most], written by {!Canonical.number}: [2], not [2.0]. *)

val decimal : ?least:float -> ?most:float -> unit -> float t
(** The same numbers, written with a point: [2.0]. *)

val any : json t
(** Any JSON, as it is. *)

val object_ : json t
(** Any object, as it is. *)

val enum : (string * 'a) list -> 'a t
(** [enum names] is one of these values, as its name. The values are constants, each with one name. *)

val const : json -> unit t
(** [const json] is only [json]. *)

val nullable : 'a t -> 'a option t
(** [null] is [None]. *)

val list : ?least:int -> ?most:int -> 'a t -> 'a list t
(** Arrays of [least] to [most] elements. *)

val map : 'a t -> (string * 'a) list t
(** Objects whose members have any names, in their order. *)

val conv : ('a -> ('b, string) result) -> ('b -> 'a) -> 'a t -> 'b t
(** [conv of_a to_a codec] reads [x] as [of_a x], or fails with its reason, and writes [y] as [to_a y]. The schema is
    that of [codec]. *)

(** {1:forms Forms that need no name} *)

type ('a, 'b) form
(** A kind of JSON for some ['a], with its content ['b]. *)

type 'a some_form = Form : ('a, 'b) form -> 'a some_form
(** A form with any content. *)

type 'a formed = As : ('a, 'b) form * 'b -> 'a formed
(** A value as its form and content. *)

val form : 'b t -> ('b -> 'a) -> ('a, 'b) form
(** [form codec make] is the values [make x] for each [x] of [codec]. *)

val either : (json -> 'a some_form) -> ('a -> 'a formed) -> 'a some_form list -> 'a t
(** [either recognise choose forms] reads [json] in the form [recognise json], and writes [x] as [choose x]. No two of
    [forms] have valid JSON in common. *)

(** {1:objects Objects} *)

type ('o, 'a) fields
(** Members of an object: an ['a] is read from them, and they are written from an ['o]. *)

val record : ('a, 'a) fields -> 'a t
(** [record fields] is objects with these members, written in their order. Members that are not known are ignored. *)

val closed : ('a, 'a) fields -> 'a t
(** [closed fields] is {!record}, but other members are faults. There is no {!union} among the fields. *)

val field : ?doc:string -> string -> 'a t -> ('o -> 'a) -> ('o, 'a) fields
(** [field name codec get] is a member that every object has; [get] takes its value from the whole. [doc] is its
    [description] in the schema. *)

val optional : ?doc:string -> ?null:bool -> string -> 'a t -> ('o -> 'a option) -> ('o, 'a option) fields
(** [optional name codec get] is [None] without the member, and then writes none. With [~null:true] a member that is
    [null] counts as absent; it is never written. *)

val default :
  ?doc:string -> ?null:bool -> ?always:bool -> 'a -> string -> 'a t -> ('o -> 'a) -> ('o, 'a) fields
(** [default x name codec get] is [x] without the member, which is not written if it equals [x], unless [always]. *)

val return : 'a -> ('o, 'a) fields
(** [return x] has no members. *)

val ( let+ ) : ('o, 'a) fields -> ('a -> 'b) -> ('o, 'b) fields
(** [let+ x = fields in e] reads the value [e], which may use what [fields] reads as [x]. *)

val ( and+ ) : ('o, 'a) fields -> ('o, 'b) fields -> ('o, 'a * 'b) fields
(** Members one after the other. *)

val part : ('p -> 'o) -> ('o, 'a) fields -> ('p, 'a) fields
(** [part get fields] is [fields], written from the part [get x] of the whole [x]. *)

val ( @& ) : ('a, 'a) fields -> ('b, 'b) fields -> ('a * 'b, 'a * 'b) fields
(** [a @& b] is the members of [a], then those of [b]; [a @& b @& c] are for [(x, (y, z))]. *)

val one : ?doc:string -> string -> 'a t -> ('a, 'a) fields
(** [one name codec] is [field name codec Fun.id]: objects with one member. *)

val fixed : string -> json -> ('o, unit) fields
(** [fixed name json] is a member that is always [json]. *)

val check : ('a -> ('b, string) result) -> ('o, 'a) fields -> ('o, 'b) fields
(** [check f fields] is [f x] of what [fields] reads, or its error. *)

val requiring : (string * string list) list -> ('o, 'a) fields -> ('o, 'a) fields
(** [requiring needs fields] has each of [needs] in its schema: with the first member of a pair come the others. That
    values are so is the matter of {!check}. *)

val members : ('o, 'a) fields -> 'o -> Field.members
(** [members fields x] is these members of [x], for an object that has others too. *)

val of_members : ('o, 'a) fields -> Field.members -> ('a, string) result
(** [of_members fields found] reads [fields] among the members of an object. *)

(** {1:unions Unions} *)

type ('a, 'b) case
(** A variant of ['a], with its content ['b]. *)

type 'a variant = Case : ('a, 'b) case -> 'a variant
(** A variant with any content. *)

type 'a chosen = Is : ('a, 'b) case * 'b -> 'a chosen
(** A value as its variant and content. *)

val case : string -> ('b, 'b) fields -> ('b -> 'a) -> ('a, 'b) case
(** [case name fields make] is a variant called [name]. *)

val constant : string -> 'a -> ('a, unit) case
(** [constant name x] has no members. *)

val union : tag:string -> 'a variant list -> ('a -> 'a chosen) -> ('a, 'a) fields
(** [union ~tag variants choose] is objects whose member [tag] has the variant's name; its members follow. *)

val union_around :
  tag:string -> ('c, 'c) fields -> 'a variant list -> ('a -> 'a chosen) -> ('c * 'a, 'c * 'a) fields
(** [union_around ~tag common variants choose] is {!union} with the members [common] of all variants after the tag. *)

val keyed : 'a variant list -> ('a -> 'a chosen) -> 'a t
(** [keyed variants choose] is objects whose first member has the variant's name; it is the first of its fields. *)

val variant : 'a variant list -> string -> (Field.members -> ('a, string) result) option
(** [variant variants name] is the reader of the members of the variant called [name], if it is one of them. *)

(** {1:schemas Schemas} *)

val named : string -> 'a t -> 'a t
(** [named name codec] has its schema once, in [$defs], and refers to it. Codecs with one name are one codec. *)

val fix : string -> ('a t -> 'a t) -> 'a t
(** [fix name f] is [f (fix name f)], {!named}. *)

val described : string -> 'a t -> 'a t
(** [described doc codec] has [doc] as its [description]. *)

val limited : (string * json) list -> 'a t -> 'a t
(** [limited keywords codec] has these keywords too in its schema: limits that {!conv} checks, or that all written
    values keep. *)

val elsewhere : string -> 'a t -> 'a t
(** [elsewhere uri codec] has its schema in another file: [{"$ref": uri}]. *)
