open Core
let vocabulary = []
let build ~name:_ site (_ : setting list) = Error (Fault.make site "no")
