(** Archives, and files of each format that are cut or changed anywhere. *)

val archive :
  ?check:(string -> int) ->
  ?pack:(string -> int * string) ->
  ?count:int ->
  ?is_zip64:bool ->
  (string * string) list ->
  string
(** [archive files] is a ZIP archive of these names and contents. *)

val cases : unit Alcotest.test_case list
