(** The files that a program names by [map 'FILE'], as values of the language. They are part of the program.

    {[
      open Dolphin_charts
      open Dolphin_semantics

      let file path =
        if path = "harbour.gpx" then Ok {|<gpx><wpt lat="41.185" lon="-8.7062"><name>buoy</name></wpt></gpx>|}
        else Error "no such file"

      let program = Result.get_ok (Dolphin_syntax.Parse.program ~file:"a.dol" "harbour = map 'harbour.gpx'")

      let () =
        match Charts.value (Charts.read file program) "harbour.gpx" with
        | Ok chart -> assert (Chart.names chart = [ "buoy" ])
        | Error _ -> assert false
    ]} *)

open Dolphin_semantics

type t

val read : (string -> (string, string) result) -> Dolphin_syntax.Ast.program -> t
(** [read file program] reads all files that [program] names so; [file path] is the content of the file [path], or
    the reason why it cannot be read. *)

val value : t -> string -> (Chart.t, string) result
(** [value charts path] is a map from the names in the file [path] to positions, lists of positions and areas, [null]
    where a feature is flawed; or what is wrong with the file, and where. *)

val identity : t -> string
(** [identity charts] is text that differs if another file is named or the contents of one have changed, [""] without
    files: behind the text of the program it makes another program of it. *)
