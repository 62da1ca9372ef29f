# fish completion of radar-display. Made by scripts/completions out of --help; changes belong there.


function __yars_sessions
    string replace -f -r '^/dev/shm/yars\.'(id -u)'\.' '' /dev/shm/yars.*
end

# Words; what follows route: and the like is a file.
function __yars_source
    set -l word (commandline -ct)
    if string match -q '*:*' -- $word
        string replace -r '^' (string split -m 1 : -- $word)[1]: (__fish_complete_path (string split -m 1 : -- $word)[2])
    else
        printf '%s\n' $argv
    end
end

complete -c radar-display -f
complete -c radar-display -s h -l help -d 'print this help'
complete -c radar-display -l version -d 'print the version'
complete -c radar-display -l session -x -a '(__yars_sessions)' -d 'session to join or create'
complete -c radar-display -l config -r -F -d 'GUF configuration file'
complete -c radar-display -l log-level -x -a 'trace debug info warning error off' -d 'lines of this level and above are logged'
complete -c radar-display -l lockstep -x -d 'roles that step together on sim time, ROLE,ROLE,...[@END_TICK]; give all these roles the same value'
complete -c radar-display -l log-dir -x -a '(__fish_complete_directories)' -d 'folder for a rotated log file'
complete -c radar-display -l realtime -d 'lock memory, run the tick loop under SCHED_FIFO; a refusal is logged'
complete -c radar-display -l cpus -x -d 'CPUs to run on, as in 2,3 or 2-3'
complete -c radar-display -l headless -d 'no window; pictures go to a folder or the session'
complete -c radar-display -l frames -x -a '(__fish_complete_directories)' -d 'folder for frame_NNNNNN.png'
complete -c radar-display -l keep -x -d 'number of newest frames that stay in the folder'
complete -c radar-display -l every -x -d '[s] sim time between frames'
complete -c radar-display -l bezel -d 'frames with the bezel and its twenty buttons around the picture'
complete -c radar-display -l show-help -d 'frames with the help over the picture'
complete -c radar-display -l tooltip -x -d 'frames with the tooltip of this button, 1 to 20'
complete -c radar-display -l no-bezel -d 'a window without the bezel; key F8 shows and hides it'
complete -c radar-display -l publish -d 'also publish pictures in the session for other programs, with edges of at most 1024 pixels'
complete -c radar-display -l size -x -d '[pixels] edge of the picture, without the bezel'
